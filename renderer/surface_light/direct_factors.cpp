#include "renderer/surface_light/direct_factors.h"

#include <algorithm>
#include <atomic>

#include <tbb/parallel_for.h>

#include "renderer/sampling/path_tracing.h"

namespace lamplighter {
namespace {

RenderPunctual withoutBrightness(RenderPunctual light) {
  light.light.intensity = light.nominal = vec3(0.0f);
  return light;
}

bool overlap(const Bounds& a, const Bounds& b) {
  return glm::all(glm::lessThanEqual(a.min, b.max)) && glm::all(glm::lessThanEqual(b.min, a.max));
}

}  // namespace

uint64_t DirectFactors::update(const Scene& now, bool isNewMesh,
                               std::span<const uint32_t> movedObjects,
                               std::span<const Bounds> boxes) {
  const std::vector<VplId> ids = emitterIds(now.lights);
  std::vector<bool> isMoved(now.mesh.objects(), false);
  for (const uint32_t o : movedObjects) isMoved[o] = true;
  std::vector<Column> before = std::move(columns_);
  columns_ = std::vector<Column>(ids.size());
  const bool isSameSky = now.lights.referenceSky().sky() == sky_;
  sky_ = now.lights.referenceSky().sky();
  std::vector<uint8_t> isStale(ids.size(), 1);
  for (size_t i = 0; i < ids.size(); ++i) {
    const Emitter& e = now.lights.emitters()[i];
    Column& column = columns_[i];
    column.id = ids[i];
    column.reference = e.reference;
    column.isColoured = EmitterFactor(now.scene, now.lights, i, now.seed).isColoured();
    if (e.kind == EmitterKind::punctual)
      column.light = withoutBrightness(now.scene.punctuals[e.punctual]);
    // Most emitters keep their place.
    size_t old = i;
    if (old >= before.size() || before[old].id != column.id)
      old = static_cast<size_t>(std::ranges::find(before, column.id, &Column::id) - before.begin());
    const size_t size = 3 * now.mesh.leaves() * (column.isColoured ? 3 : 1);
    if (!isNewMesh && old < before.size() && before[old].light == column.light &&
        before[old].reference == column.reference && before[old].factors.size() == size &&
        (e.kind != EmitterKind::sky || isSameSky) &&
        !(e.kind == EmitterKind::surface && isMoved[e.object])) {
      column.factors = std::move(before[old].factors);
      isStale[i] = 0;
    } else {
      column.factors.assign(size, 0.0f);
    }
  }
  uint64_t rays = 0;
  computed_ = masked_ = open_ = 0;
  if (now.mask != 0) blockers_.update(now.scene, isNewMesh || mask_ == 0, movedObjects);
  if (now.mask != mask_) std::ranges::fill(isStale, uint8_t{1});
  mask_ = now.mask;
  const bool isOtherwiseMixed =
      wasMixed_.size() != now.isMixed.size() || !std::ranges::equal(wasMixed_, now.isMixed);
  if (!boxes.empty() || isOtherwiseMixed || std::ranges::count(isStale, 1) > 0)
    find(now, isStale, isMoved, boxes, rays);
  wasMixed_.assign(now.isMixed.begin(), now.isMixed.end());
  return rays;
}

void DirectFactors::find(const Scene& now, const std::vector<uint8_t>& isStale,
                         const std::vector<bool>& isMoved, std::span<const Bounds> boxes,
                         uint64_t& rays) {
  std::vector<EmitterFactor> emitters;
  std::vector<std::optional<FlatLight>> flat;
  for (size_t e = 0; e < columns_.size(); ++e) {
    emitters.emplace_back(now.scene, now.lights, e, now.seed);
    flat.push_back(emitters.back().flat(now.mask));
  }
  std::atomic<uint64_t> traced = 0, computed = 0, masked = 0, open = 0;
  tbb::parallel_for(size_t{0}, now.mesh.leaves(), [&](size_t k) {
    const auto leaf = static_cast<uint32_t>(k);
    const uint32_t object = now.mesh.objectOfLeaf(leaf);
    const uint32_t leftOutBy = now.scene.objects[object].leftOutBy;
    std::vector<SurfaceSpot> spots;
    Bounds own;
    if (now.isMixed[k] != 0) {
      for (const uint32_t sample : now.mesh.samplesOfLeaf(leaf))
        spots.push_back(spotAt(now.scene, object, now.mesh.placesOfSample(sample)[0]));
    } else {
      for (const SurfacePlace& place : now.mesh.placesOfLeaf(leaf))
        spots.push_back(spotAt(now.scene, object, place));
    }
    for (const SurfaceSpot& spot : spots) own.add(spot.position);
    const bool isOther = k >= wasMixed_.size() || wasMixed_[k] != now.isMixed[k];
    const bool isCluster = now.mesh.isCluster(leaf);
    const uint32_t key = leaf - now.mesh.part(object).firstLeaf;
    std::vector<LightRay> lights;
    for (size_t e = 0; e < emitters.size(); ++e) {
      const bool isNew = isStale[e] != 0 || isMoved[object] || isOther;
      if (!isNew) {
        Bounds shaft = own;
        shaft.add(emitters[e].bounds());
        const bool isFar = emitters[e].bounds().empty();
        if (std::ranges::none_of(boxes,
                                 [&](const Bounds& b) { return isFar || overlap(b, shaft); }))
          continue;
      }
      emitters[e].raysTo(spots, leftOutBy, key, lights);
      const auto touches = [&](const LightRay& l) {
        return std::ranges::any_of(boxes, [&](const Bounds& b) { return mayTouch(l.ray, b); });
      };
      // A mask shows the whole light, not only where the rays go.
      if (!isNew && !flat[e] && std::ranges::none_of(lights, touches)) continue;
      std::array<vec3, 3> corners{};
      for (const LightRay& l : lights) {
        float share = 0.0f;
        const auto byMask = flat[e] ? maskedShare(now.scene, blockers_, *flat[e], spots[l.spot])
                                    : std::optional<MaskedShare>();
        if (byMask) {
          share = byMask->share;
          ++(byMask->isOpen ? open : masked);
        } else {
          share = now.rays.occluded(l.ray) ? 0.0f : 1.0f;
          ++traced;
        }
        if (!isCluster)
          corners[l.spot] = share * l.irradiance;
        else
          corners[0] += share * l.irradiance / static_cast<float>(spots.size());
      }
      if (isCluster) corners[1] = corners[2] = corners[0];
      ++computed;
      Column& column = columns_[e];
      const int channels = column.isColoured ? 3 : 1;
      float* out = &column.factors[3 * k * static_cast<size_t>(channels)];
      for (const vec3& corner : corners)
        for (int c = 0; c < channels; ++c) *out++ = corner[c];
    }
  });
  rays += traced;
  computed_ = computed;
  masked_ = masked;
  open_ = open;
}

void DirectFactors::sum(const LightSet& lights, std::vector<vec3>& out) const {
  tbb::parallel_for(size_t{0}, out.size(), [&](size_t k) {
    vec3 sum(0.0f);
    for (size_t e = 0; e < columns_.size(); ++e) {
      const Column& column = columns_[e];
      const vec3& gain = lights.emitters()[e].gain;
      sum += column.isColoured ? gain * vec3(column.factors[3 * k], column.factors[3 * k + 1],
                                             column.factors[3 * k + 2])
                               : gain * column.factors[k];
    }
    out[k] = sum;
  });
}

size_t DirectFactors::bytes() const {
  size_t bytes = 0;
  for (const Column& column : columns_) bytes += column.factors.size() * sizeof(float);
  return bytes;
}

}  // namespace lamplighter
