#include "renderer/texels/texel_sky.h"

#include <algorithm>
#include <atomic>

#include <tbb/parallel_for.h>

#include "renderer/base/random.h"
#include "renderer/scene/light_linking.h"
#include "renderer/texels/depth_map_layout.h"

namespace lamplighter {
namespace {

// One direction per pixel of an octahedral map, at one of kParts² positions in the pixel. The
// position differs from texel to texel, so that windows are not too bright or too dark for a whole
// wall.
constexpr int kSkySide = 32, kParts = 4;
constexpr DepthMapLayout kSkyPlaces{DepthMapKind::octahedral, kParts* kSkySide};
constexpr uint32_t kDirections = kSkySide * kSkySide;
constexpr size_t kWords = kDirections / 64;
constexpr uint32_t kSkySet = 0x5c;
// Number of texels per work step.
constexpr size_t kTexelsAStep = 64;

// The position with a number from 0 to kParts² − 1.
uint32_t skyPlaceOf(uint32_t pixel, uint32_t number) {
  const uint32_t x = kParts * (pixel % kSkySide) + number % kParts;
  const uint32_t y = kParts * (pixel / kSkySide) + number / kParts;
  return y * kParts * kSkySide + x;
}

std::vector<vec3> directionsOfSkyPlaces() {
  std::vector<vec3> out(kSkyPlaces.pixels());
  for (uint32_t q = 0; q < out.size(); ++q) out[q] = kSkyPlaces.directionOf(q);
  return out;
}

vec3 skyDirectionOf(const std::vector<vec3>& places, const SurfaceTexel& texel, uint32_t pixel) {
  return places[skyPlaceOf(pixel, hash4(seedOf(texel), pixel, 0, kSkySet) % (kParts * kParts))];
}

}  // namespace

void TexelSky::restart(size_t texels) {
  *this = {};
  count_ = texels;
  bits_.assign(kWords * texels, 0);
}

void TexelSky::outdate(TexelMoves moves) {
  const size_t now = moves.formerTexel.size();
  if (!isDone() || count_ == 0) return restart(0);
  std::vector<uint64_t> bits(kWords * now, 0);
  for (size_t t = 0; t < now; ++t)
    if (moves.formerTexel[t] != TexelMoves::kNew)
      std::copy_n(bits_.begin() + static_cast<ptrdiff_t>(kWords * moves.formerTexel[t]), kWords,
                  bits.begin() + static_cast<ptrdiff_t>(kWords * t));
  restart(now);
  bits_ = std::move(bits);
  moves_ = std::move(moves);
}

uint64_t TexelSky::goOn(const TexelSet& texels, const Open& isOpen, uint64_t most) {
  const std::vector<vec3> places = directionsOfSkyPlaces();
  std::atomic<uint64_t> tested = 0;
  while (!isDone() && tested < most) {
    const size_t end = std::min(count_, next_ + kTexelsAStep);
    tbb::parallel_for(next_, end, [&](size_t t) {
      const SurfaceTexel& texel = texels[t];
      const bool isKnown = moves_.isKept(t);
      uint64_t own = 0;
      for (uint32_t pixel = 0; pixel < kDirections; ++pixel) {
        const vec3 d = skyDirectionOf(places, texel, pixel);
        if (glm::dot(d, texel.spot.geometricNormal) <= 0.0f) continue;
        if (isKnown && !moves_.meets({texel.spot.rayOrigin(), 0.0f, d})) continue;
        uint64_t& word = bits_[kWords * t + pixel / 64];
        const uint64_t bit = uint64_t{1} << pixel % 64;
        word = isOpen(static_cast<uint32_t>(t), d) ? word | bit : word & ~bit;
        ++own;
      }
      tested += own;
    });
    next_ = end;
  }
  if (isDone()) moves_ = {};
  return tested;
}

std::vector<vec3> TexelSky::light(const RenderScene& scene, const LightSet& lights,
                                  const TexelSet& texels) const {
  std::vector<vec3> out(count_, vec3(0.0f));
  if (lights.unitSky().isBlack()) return out;
  const std::vector<vec3> places = directionsOfSkyPlaces();
  std::vector<vec3> light(kDirections, vec3(0.0f));  // radiance times solid angle
  tbb::parallel_for(0u, kDirections, [&](uint32_t pixel) {
    for (uint32_t k = 0; k < kParts * kParts; ++k) {
      const uint32_t q = skyPlaceOf(pixel, k);
      light[pixel] += kSkyPlaces.solidAngleOf(q) * lights.referenceSky().withoutSuns(places[q]) /
                      lights.skyReference();
    }
  });
  tbb::parallel_for(size_t{0}, next_, [&](size_t t) {
    const SurfaceTexel& texel = texels[t];
    if (isLeftOut(scene.objects[texel.object].leftOutBy, scene.skyLink)) return;
    for (uint32_t pixel = 0; pixel < kDirections; ++pixel) {
      if ((bits_[kWords * t + pixel / 64] >> pixel % 64 & 1u) == 0) continue;
      const float cosine = glm::dot(texel.spot.normal, skyDirectionOf(places, texel, pixel));
      out[t] += std::max(cosine, 0.0f) * light[pixel];
    }
  });
  return out;
}

}  // namespace lamplighter
