#include "renderer/backends/cpu/many_lights/specular_samples.h"

#include <algorithm>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/backends/cpu/irradiance/specular_shading.h"
#include "shaders/shared/brdf.h"

namespace lamplighter::cpu {
namespace {

// What is divided out of the light of a sample, so that textures of metals stay sharp: the Fresnel
// reflectance of the lobe at a moderate angle.
vec3 reflectance(const vec3& albedo, const Gloss& gloss) {
  constexpr float kAway = 0.03f;  // (1 − cos 60°)⁵
  const shared::Lobe lobe = shared::makeLobe(albedo, gloss.metallic, gloss.roughness, 0.0f, 1.0f);
  return glm::mix(vec3(lobe.straight), vec3(lobe.straight.w), kAway);
}

// The samples around a pixel that lie on its object count at least so much.
constexpr float kLeastShare = 1e-3f;

// How alike the shading normals at two points are: cos³² of the angle between them.
float likeness(const GBuffer& a, size_t i, const GBuffer& b, size_t j) {
  float power = std::max(a.sx[i] * b.sx[j] + a.sy[i] * b.sy[j] + a.sz[i] * b.sz[j], 0.0f);
  for (int square = 0; square < 5; ++square) power *= power;
  return power;
}

}  // namespace

uint64_t SpecularSamples::update(const RenderScene& scene, const GBuffer& g,
                                 const LowResolution& low, const vec3& eye,
                                 std::vector<SpecularLight> lights, const SumConstants& constants,
                                 float leastRoughness, const PatchLights* patches) {
  isOn_ = true;
  eye_ = eye;
  leastRoughness_ = leastRoughness;
  tiles_.resize(static_cast<size_t>(g.tiles()));
  const std::vector<uint8_t> mayBeGlossy = findGlossy(scene);
  tbb::parallel_for(size_t{0}, tiles_.size(), [&](size_t i) {
    if (tiles_[i].revision == g.revision[i]) return;
    Tile& tile = tiles_[i];
    tile = {g.revision[i], findGloss(scene, g, i, mayBeGlossy)};
    for (const Gloss& gloss : tile.gloss)
      tile.glossyPixels += shared::isGlossy(gloss.metallic, gloss.roughness) ? 1 : 0;
  });
  return sums_.update(scene, low.samples(), eye, std::move(lights), constants, leastRoughness,
                      patches, false);
}

uint64_t SpecularSamples::glossyPixels() const {
  uint64_t pixels = 0;
  for (const Tile& tile : tiles_) pixels += tile.glossyPixels;
  return pixels;
}

// By pixel of the G-buffer of samples. Divided once here, not for each pixel around a sample.
std::vector<SpecularSamples::Demodulated> SpecularSamples::demodulated(
    const GBuffer& samples) const {
  std::vector<Demodulated> out(samples.hit.size());
  tbb::parallel_for(0, samples.tiles(), [&](int tile) {
    const size_t first = static_cast<size_t>(tile) * kTilePixels;
    for (size_t i = first; i < first + kTilePixels; ++i) {
      if (samples.hit[i] == 0) continue;
      if (const auto there = sums_.reflection(i))
        out[i] = {there->radiance / reflectance(samples.albedo(i), there->gloss), true};
    }
  });
  return out;
}

void SpecularSamples::addTo(const GBuffer& g, const LowResolution& low, Image& picture) const {
  const GBuffer& samples = low.samples();
  const std::vector<Demodulated> light = demodulated(samples);
  tbb::parallel_for(size_t{0}, tiles_.size(), [&](size_t t) {
    forEachGlossy(g, t, tiles_[t].gloss, [&](int x, int y, size_t i, const Gloss& gloss) {
      vec3 sum(0.0f);
      float weights = 0.0f;
      for (const LowResolution::Corner& c : low.cornersOf(x, y)) {
        const size_t sample = samples.index(c.i, c.j);
        if (!light[sample].isKnown || samples.object[sample] != g.object[i]) continue;
        const float weight = (c.share + kLeastShare) * likeness(g, i, samples, sample);
        sum += weight * light[sample].radiance;
        weights += weight;
      }
      if (weights > 0.0f)
        addSpecular(g, i, eye_, gloss, leastRoughness_,
                    sum / weights * reflectance(g.albedo(i), gloss), true, picture.at(x, y));
    });
  });
}

size_t SpecularSamples::bytes() const {
  size_t bytes = sums_.bytes();
  for (const Tile& tile : tiles_) bytes += tile.gloss.size() * sizeof(Gloss);
  return bytes;
}

}  // namespace lamplighter::cpu
