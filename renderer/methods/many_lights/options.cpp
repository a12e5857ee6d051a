#include "renderer/methods/many_lights/options.h"

#include <algorithm>

#include "renderer/methods/common_parameters.h"
#include "renderer/methods/many_lights/parameters.h"

namespace lamplighter {
namespace {

// Refinement gets this fraction (1/4) of the memory of shadow maps.
constexpr int kRefinementShare = 4;

// The cpu backend stores texel indices as floats.
constexpr int kLargestMap = 1024;

size_t bytesOfMap(int resolution) {
  return sizeof(float) * static_cast<size_t>(resolution) * static_cast<size_t>(resolution);
}

}  // namespace

ManyLightsOptions::ManyLightsOptions(const Settings& settings, bool refines) {
  counts.total = settings.integer(parameters::vpls());
  counts.directShare = settings.real(parameters::directShare());
  counts.bounces = settings.integer(parameters::bounces());
  counts.seed = static_cast<uint32_t>(settings.integer(parameters::seed()));
  counts.candidates = settings.integer(parameters::importance());
  counts.sunMaps = settings.integer(parameters::sunMaps());
  mapResolution = settings.integer(parameters::mapResolution());
  mapScale = settings.integer(parameters::settledMapScale());
  const auto bytesOf = [&](const ParameterSpec& mebibytes) {
    return static_cast<size_t>(settings.integer(mebibytes)) << 20;
  };
  mapBytes = bytesOf(parameters::mapMemory());
  budget.vpls = settings.integer(parameters::updates());
  const auto limit = [&](const ParameterSpec& spec) {
    const int value = settings.integer(spec);
    return value == 0 ? kNoLimit : static_cast<uint64_t>(value);
  };
  budget.work = {limit(parameters::maxShadowMaps()), limit(parameters::maxVisibilityTests()),
                 limit(parameters::maxLightMapTexels()), limit(parameters::maxRays())};
  mostPaths = settings.integer(parameters::maxPaths());
  clampDistance = settings.real(parameters::clampDistance());
  shadowBias = settings.real(parameters::shadowBias());
  antialias = settings.integer(parameters::antialias());
  const std::string technique = settings.choice(parameters::technique());
  useLightMaps = technique == "light_maps";
  useVisibility = useLightMaps || technique == "visibility";
  visibilityBytes = bytesOf(parameters::visibilityMemory());
  lightMapBytes = bytesOf(parameters::lightMapMemory());
  groupShare = 0.01f * settings.real(parameters::groupShare());
  lightMapTexel = settings.real(parameters::lightMapTexel());
  lightsPerPass = settings.integer(parameters::lightsPerPass());
  mergePasses = settings.boolean(parameters::mergePasses());
  block = useVisibility ? std::stoi(settings.choice(parameters::block())) : 1;
  speculars = settings.boolean(parameters::speculars());
  leastRoughness = settings.real(parameters::leastRoughness());
  usePrt = useVisibility && settings.boolean(parameters::prt());
  fillsCorners = settings.boolean(parameters::cornerLight()) && clampDistance > 0.0f;
  // Each interreflection within an object counts as a bounce, like a bounce of a VPL.
  prt.transfer.bounces = std::min(counts.bounces, settings.integer(parameters::prtBounces()));
  prt.mostPoints = settings.integer(parameters::prtPoints());
  prt.mostError = settings.real(parameters::prtError());
  prt.mostBytes = bytesOf(parameters::prtMemory());
  prt.clampDistance = clampDistance;
  VplCounts refined = counts;
  refined.candidates = 1;
  refinement = {refines ? settings.integer(parameters::refine()) : 0,
                refined,
                mapResolution,
                clampDistance,
                shadowBias,
                lightsPerPass,
                speculars,
                leastRoughness,
                std::max(mostMaps() / kRefinementShare, 1)};
}

int ManyLightsOptions::mostMaps() const {
  return static_cast<int>(
      std::clamp<size_t>(mapBytes / bytesOfMap(mapResolution), 2, size_t{1} << 20));
}

ManyLightsOptions::MapRooms ManyLightsOptions::mapRooms(int slots) const {
  MapRooms rooms{{mapResolution, std::min(slots, mostMaps())}, {}};
  const auto all = static_cast<size_t>(slots);
  const auto fits = [&](int scale) {
    return all * (bytesOfMap(mapResolution) + bytesOfMap(scale * mapResolution)) <= mapBytes;
  };
  int scale = std::min(mapScale, kLargestMap / mapResolution);
  while (scale > 1 && !fits(scale)) --scale;
  if (scale > 1) rooms.fine = {scale * mapResolution, slots};
  return rooms;
}

void ManyLightsOptions::forgoVisibility() {
  useVisibility = useLightMaps = usePrt = false;
  block = 1;
}

}  // namespace lamplighter
