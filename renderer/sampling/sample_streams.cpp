#include "renderer/sampling/sample_streams.h"

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"

namespace lamplighter {
namespace {

constexpr uint32_t kBatchSet = 0x2d;

}  // namespace

SampleStreams::SampleStreams(const VplCounts& counts)
    : seed_(counts.batch == 0 ? counts.seed : hash4(counts.seed, 0, 0, kBatchSet)),
      turn_(counts.batch == 0 ? 0 : hash4(counts.seed, counts.batch, 0, kBatchSet)) {}

vec2 SampleStreams::point(const VplId& light, uint32_t index, uint32_t dimension,
                          uint32_t set) const {
  const uint32_t scramble = hash4(light.light, light.emitter, seed_, set);
  // Padded dimensions must not be correlated, so all but the first are shuffled.
  return dimension == 0 ? sobol2Ordered(index, scramble)
                        : sobol2(index, hash4(scramble, dimension, 0, 0));
}

vec3 SampleStreams::turnedTangent(const VplId& id, const vec3& normal) const {
  const Frame frame(normal);
  const float angle =
      2.0f * kPi * toUnitFloat(hash4(id.light, id.emitter, id.bounce, id.index ^ turn_));
  return glm::normalize(std::cos(angle) * frame.tangent + std::sin(angle) * frame.bitangent);
}

SceneVpl SampleStreams::makeVpl(const VplId& id, float kind, const vec3& position,
                                const vec3& normal, const vec3& intensity) const {
  SceneVpl made;
  made.vpl = {vec4(position, kind), vec4(normal, 0.0f), vec4(turnedTangent(id, normal), 1.0f),
              intensity, -1};
  made.id = id;
  return made;
}

}  // namespace lamplighter
