#include "renderer/texels/texel_light.h"

#include <algorithm>
#include <atomic>

#include <tbb/parallel_for.h>

#include "renderer/sampling/path_tracing.h"
#include "renderer/scene/light_linking.h"
#include "renderer/surface_light/emitter_factor.h"

namespace lamplighter {
namespace {

// Number of rays from a texel to a light that is not a point.
constexpr size_t kRays = 4;

}  // namespace

void TexelLight::outdate(const TexelMoves& moves, bool haveTexelsMoved) {
  moves_ = moves;
  for (Column& column : columns_) {
    const bool isCurrent = column.since == Since::move && !haveTexelsMoved;
    column.isKept = column.since == Since::rest && column.known == column.factors.size();
    if (!column.factors.empty()) column.factors = moves.carried(column.factors);
    if (!isCurrent) column.first = column.known = 0;
    column.since = Since::rest;
  }
  seenSky_.outdate(moves);
  skyLight_ = moves.carried(skyLight_);
  sky_ = {};
}

uint64_t TexelLight::update(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
                            const TexelSet& texels, std::span<const uint32_t> movedObjects,
                            uint32_t seed, uint64_t most, bool withoutSurfaces) {
  changed_ = false;
  if (texels.size() == 0) {
    columns_.clear();
    return 0;
  }
  const std::vector<VplId> ids = emitterIds(lights);
  std::vector<Column> before = std::exchange(columns_, std::vector<Column>(ids.size()));
  for (size_t e = 0; e < ids.size(); ++e) {
    const Emitter& light = lights.emitters()[e];
    Column& column = columns_[e];
    column.id = ids[e];
    if (light.kind == EmitterKind::punctual)
      column.light = withoutBrightness(scene.punctuals[light.punctual]);
    const auto old = std::ranges::find(before, column.id, &Column::id);
    if (old != before.end()) {
      column.factors = std::move(old->factors);
      const bool isMoved = light.kind == EmitterKind::surface &&
                           std::ranges::find(movedObjects, light.object) != movedObjects.end();
      const bool isSame = old->light == column.light && !isMoved;
      column.first = isSame ? old->first : (old->first + old->known) % texels.size();
      if (isSame) {
        column.known = old->known;
        column.isKept = old->isKept;
        const bool isWhole = old->since == Since::rest && old->known == texels.size();
        column.since = movedObjects.empty() || isWhole ? old->since : Since::mixed;
      } else {
        column.since = movedObjects.empty() ? Since::rest : Since::move;
      }
    } else {
      changed_ = true;
      column.since = movedObjects.empty() ? Since::rest : Since::move;
    }
    const bool isLeftOut = withoutSurfaces && light.kind == EmitterKind::surface;
    column.factors.resize(isLeftOut ? 0 : texels.size(), vec3(0.0f));
    if (isLeftOut) column.first = column.known = 0;
  }
  std::atomic<uint64_t> traced = 0;
  for (size_t e = 0; e < columns_.size() && traced < most; ++e) {
    Column& column = columns_[e];
    if (column.factors.empty()) continue;  // left out
    const EmitterFactor factor(scene, lights, e, column.id, seed);
    const bool isPoint = lights.emitters()[e].kind == EmitterKind::punctual;
    const size_t raysOfTexel = factor.isSampled() ? (isPoint ? 1 : kRays) : 0;
    if (raysOfTexel == 0) column.known = texels.size();
    if (column.known == texels.size()) continue;
    const size_t end =
        std::min(texels.size(), column.known + std::max<size_t>(1, (most - traced) / raysOfTexel));
    tbb::parallel_for(column.known, end, [&](size_t i) {
      const size_t t = (column.first + i) % texels.size();
      const SurfaceTexel& texel = texels[t];
      const std::vector<SurfaceSpot> spots(raysOfTexel, texel.spot);
      std::vector<LightRay> found;
      factor.raysTo(spots, scene.objects[texel.object].leftOutBy, seedOf(texel), found);
      const bool isKept =
          column.isKept && moves_.isKept(t) &&
          std::ranges::none_of(found, [&](const LightRay& r) { return moves_.meets(r.ray); });
      if (isKept) return;
      vec3 sum(0.0f);
      for (const LightRay& r : found)
        if (!rays.occluded(r.ray)) sum += r.irradiance;
      column.factors[t] = sum / static_cast<float>(raysOfTexel);
      traced += found.size();
    });
    column.known = end;
    changed_ = true;
  }
  return traced;
}

uint64_t TexelLight::updateSky(const RenderScene& scene, const LightSet& lights,
                               const TexelSet& texels, const TexelSky::Open& isOpen,
                               uint64_t most) {
  const Sky sky = lights.unitSky();
  if (sky == sky_ && skyLight_.size() == texels.size() && seenSky_.isDone()) return 0;
  uint64_t tested = 0;
  if (sky.isBlack()) {
    skyLight_.assign(texels.size(), vec3(0.0f));
    seenSky_.restart(0);
  } else {
    if (seenSky_.texels() != texels.size()) seenSky_.restart(texels.size());
    tested = seenSky_.goOn(texels, isOpen, most);
    if (!seenSky_.isDone()) return tested;
    skyLight_ = seenSky_.light(scene, lights, texels);
  }
  sky_ = sky;
  changed_ = true;
  return tested;
}

bool TexelLight::isDone() const {
  return seenSky_.isDone() &&
         std::ranges::all_of(columns_, [](const Column& c) { return c.known == c.factors.size(); });
}

void TexelLight::sum(const LightSet& lights, std::vector<vec3>& out) const {
  vec3 sky(0.0f);
  for (const Emitter& e : lights.emitters())
    if (e.kind == EmitterKind::sky && e.skySun == 0) sky = e.brightness();
  tbb::parallel_for(size_t{0}, out.size(), [&](size_t t) {
    out[t] = skyLight_.size() > t ? sky * skyLight_[t] : vec3(0.0f);
    for (size_t e = 0; e < columns_.size(); ++e)
      if (!columns_[e].factors.empty())
        out[t] += lights.emitters()[e].brightness() * columns_[e].factors[t];
  });
}

size_t TexelLight::bytes() const {
  size_t bytes = skyLight_.size() * sizeof(vec3) + seenSky_.bytes();
  for (const Column& c : columns_) bytes += c.factors.size() * sizeof(vec3);
  return bytes;
}

}  // namespace lamplighter
