#include "renderer/methods/texel_mirror.h"

#include <algorithm>
#include <array>

namespace lamplighter {
namespace {

// A place is encoded as a texel and, in eight bits each, the weights and sides of the two
// neighbouring texels in its row and column.
constexpr float kMostWeight = 127.0f;

uint64_t packedBlend(uint32_t texel, float right, float up, bool isLeft, bool isDown) {
  const auto bits = [](float weight, bool isOther) {
    const auto w = static_cast<uint64_t>(std::clamp(weight, 0.0f, 1.0f) * kMostWeight + 0.5f);
    return w | (isOther ? 128u : 0u);
  };
  return texel | bits(right, isLeft) << 32 | bits(up, isDown) << 40;
}

constexpr uint64_t kDarkPlace = TexelSet::kNone;

}  // namespace

uint64_t TexelMirror::placeOf(const Ray& ray, const Hit& hit) const {
  const TexelBlend blend =
      light_->blendAt(*scene_, *rays_, hit.object, hit.triangle,
                      isOnBack(*scene_, hit, ray.direction), ray.origin + hit.t * ray.direction);
  if (!blend.isAny()) return kDarkPlace;
  // Weights of a bilinear blend: the texels 0, 1 are a row, and 2, 3 the next one.
  const auto largest =
      static_cast<size_t>(std::ranges::max_element(blend.weights) - blend.weights.begin());
  const size_t inRow = largest ^ 1u, inColumn = largest ^ 2u;
  const float right = blend.weights[inRow] / (blend.weights[largest] + blend.weights[inRow]);
  const float up = blend.weights[inColumn] / (blend.weights[largest] + blend.weights[inColumn]);
  return packedBlend(blend.texels[largest], right, up, inRow < largest, inColumn < largest);
}

vec3 TexelMirror::radianceOf(uint64_t place) const {
  const auto texel = static_cast<uint32_t>(place);
  const std::vector<vec3>& reflected = light_->reflected();
  if (texel >= reflected.size()) return vec3(0.0f);
  const TexelSet& texels = light_->texels();
  const SurfaceTexel& own = texels[texel];
  const bool isBack = own.place.triangle >= scene_->objects[own.object].triangleCount();
  const auto step = [&](uint64_t bits, const glm::ivec2& to, float& weight) {
    weight = static_cast<float>(bits & 127u) / kMostWeight;
    const bool isOther = (bits & 128u) != 0;
    return isOther ? -to : to;
  };
  float right = 0.0f, up = 0.0f;
  const glm::ivec2 inRow = step(place >> 32, {1, 0}, right),
                   inColumn = step(place >> 40, {0, 1}, up);
  vec3 sum(0.0f);
  float weights = 0.0f;
  for (int k = 0; k < 4; ++k) {
    const float weight = (k % 2 == 1 ? right : 1.0f - right) * (k / 2 == 1 ? up : 1.0f - up);
    if (weight <= 0.0f) continue;
    const glm::ivec2 at =
        own.at + (k % 2 == 1 ? inRow : glm::ivec2(0)) + (k / 2 == 1 ? inColumn : glm::ivec2(0));
    const uint32_t other = texels.texelAt(own.object, isBack, vec2(at) + 0.5f);
    if (other == TexelSet::kNone) continue;
    sum += weight * reflected[other];
    weights += weight;
  }
  return weights > 0.0f ? sum / (kPi * weights) : vec3(0.0f);
}

float TexelMirror::areaOf(uint64_t place) const {
  const auto texel = static_cast<uint32_t>(place);
  const TexelSet& texels = light_->texels();
  return texel < texels.size() ? texels[texel].area : 0.0f;
}

}  // namespace lamplighter
