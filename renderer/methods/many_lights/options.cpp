#include "renderer/methods/many_lights/options.h"

#include <algorithm>
#include <utility>

#include "renderer/methods/carrier_rule.h"

namespace lamplighter {
namespace {

// Refinement gets this fraction (1/4) of the memory of shadow maps.
constexpr int kRefinementShare = 4;

// The cpu backend stores texel indices as floats.
constexpr int kLargestMap = 1024;

// Maximum number of candidates, so that paths fit into memory; and minimum number per sample.
constexpr int kMostCandidates = 1 << 16, kCheapCandidates = 8;

size_t bytesOfMap(int resolution) {
  return sizeof(float) * static_cast<size_t>(resolution) * static_cast<size_t>(resolution);
}

uint64_t limitOf(int parameter) {
  return parameter == 0 ? kNoLimit : static_cast<uint64_t>(parameter);
}

}  // namespace

ManyLightsOptions::ManyLightsOptions(const Settings& settings, bool refines, bool onProcessor,
                                     const RenderScene& scene)
    : ManyLightsParameters(manyLightsParameters().read(settings)) {
  if (indirect == ManyLightsIndirect::automatic) choose(onProcessor, scene);
  if (indirect == ManyLightsIndirect::meshes) {
    meshBounces = std::exchange(bounces, 0);
    directShare = 1.0f;
  }
  if (indirect == ManyLightsIndirect::links) {
    linkBounces = std::exchange(bounces, 0);
    directShare = 1.0f;
  }
  if (indirect == ManyLightsIndirect::field) {
    fieldBounces = std::exchange(bounces, 0);
    directShare = 1.0f;
  }
  if (indirect == ManyLightsIndirect::imperfect) {
    imperfectBounces = std::exchange(bounces, 0);
    directShare = 1.0f;
  }
  if (!useVisibility()) forgoVisibility();
  if (clampDistance <= 0.0f) biasCompensation = false;
  if (!refines) refine = 0;
  groupShare *= 0.01f;  // percent to a share of 1
  // Each interreflection within an object counts as a bounce, like a bounce of a VPL.
  prtBounces = std::min(bounces, prtBounces);
}

void ManyLightsOptions::choose(bool onProcessor, const RenderScene& scene) {
  if (!onProcessor || prt) {
    indirect = ManyLightsIndirect::samples;
    // Transfer takes the bounces within an object from those of light samples.
    carrierReason = onProcessor ? "samples: with prt" : "samples: on this backend";
    return;
  }
  const CarrierChoice choice = carrierFor(scene, texel);
  switch (choice.carrier) {
    case BouncedCarrier::meshes:
      indirect = ManyLightsIndirect::meshes;
      carrierReason = "meshes: " + choice.reason;
      return;
    case BouncedCarrier::links:
      indirect = ManyLightsIndirect::links;
      carrierReason = "links: " + choice.reason;
      return;
    case BouncedCarrier::imperfect:
      indirect = ManyLightsIndirect::imperfect;
      carrierReason = "imperfect: " + choice.reason;
  }
}

ImperfectParameters ManyLightsOptions::imperfect() const {
  ImperfectParameters out;
  static_cast<SurfaceParameters&>(out) = *this;
  out.seed = seed;
  out.bounces = imperfectBounces;
  out.updates = updates;
  out.clampDistance = clampDistance;
  out.biasCompensation = biasCompensation;
  return out;
}

void ManyLightsOptions::forgoVisibility() {
  technique = ManyLightsTechnique::naive;
  prt = false;
  block = 1;
}

VplCounts ManyLightsOptions::counts() const {
  VplCounts counts;
  counts.total = vpls;
  counts.directShare = directShare;
  counts.bounces = bounces;
  counts.seed = static_cast<uint32_t>(seed);
  counts.candidates = std::min(importance, std::max(kMostCandidates / vpls, kCheapCandidates));
  counts.withoutSky = useMeshes() || useField();
  counts.withoutSurfaces = withoutSurfaces;
  counts.sunMaps = sunMaps;
  return counts;
}

RefreshBudget ManyLightsOptions::budget() const {
  return {updates,
          {limitOf(maxShadowMaps), limitOf(maxVisibilityTests), limitOf(maxLightMapTexels),
           limitOf(maxRays)}};
}

PrtLights::Options ManyLightsOptions::transfer() const {
  PrtLights::Options options;
  options.transfer.bounces = prtBounces;
  options.mostPoints = prtPoints;
  options.clampDistance = clampDistance;
  options.mostError = prtError;
  options.mostBytes = bytesOf(prtMemory);
  return options;
}

Refinement::Options ManyLightsOptions::refinement() const {
  VplCounts refined = counts();
  refined.candidates = 1;
  return {refine,        refined,        mapResolution,
          clampDistance, shadowBias,     lightsPerPass,
          speculars,     leastRoughness, std::max(mostMaps() / kRefinementShare, 1)};
}

int ManyLightsOptions::mostMaps() const {
  return static_cast<int>(
      std::clamp<size_t>(bytesOf(mapMemory) / bytesOfMap(mapResolution), 2, size_t{1} << 20));
}

ManyLightsOptions::MapRooms ManyLightsOptions::mapRooms(int slots) const {
  MapRooms rooms{{mapResolution, std::min(slots, mostMaps())}, {}};
  const auto all = static_cast<size_t>(slots);
  const auto fits = [&](int scale) {
    return all * (bytesOfMap(mapResolution) + bytesOfMap(scale * mapResolution)) <=
           bytesOf(mapMemory);
  };
  int scale = std::min(settledMapScale, kLargestMap / mapResolution);
  while (scale > 1 && !fits(scale)) --scale;
  if (scale > 1) rooms.fine = {scale * mapResolution, slots};
  return rooms;
}

}  // namespace lamplighter
