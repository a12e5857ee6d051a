#include "renderer/light_field/field_gather.h"

#include <algorithm>

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

constexpr size_t kGatheredATime = 256;

// `receiverAt`: the receiver of a sum.
template <typename ReceiverAt>
void gather(std::span<const FieldReceiver> receivers, const ReceiverAt& receiverAt,
            const FieldDirections& directions, std::span<const PartnerRow> rows,
            const PartnerRadiance& radiance, FieldSums& sums) {
  const size_t groups = (sums.size() + kGatheredATime - 1) / kGatheredATime;
  tbb::parallel_for(size_t{0}, groups, [&](size_t group) {
    const size_t end = std::min(sums.size(), (group + 1) * kGatheredATime);
    for (const PartnerRow& row : rows) {
      const vec3 along = directions[row.direction];
      const float weight = directions.weightOf(row.direction);
      for (size_t s = group * kGatheredATime; s < end; ++s) {
        const size_t r = receiverAt(s);
        const FieldReceiver& to = receivers[r];
        const bool isOpposite = glm::dot(to.geometricNormal, along) < 0.0f;
        const float cosine = glm::dot(to.normal, along);
        const float share = weight * std::max(0.0f, isOpposite ? -cosine : cosine);
        const vec4& light = radiance[row.partners[r]];
        sums[s] += share * vec4(light.x, light.y, light.z, 1.0f);
      }
    }
  });
}

}  // namespace

void addGathered(std::span<const FieldReceiver> receivers, const FieldDirections& directions,
                 std::span<const PartnerRow> rows, const PartnerRadiance& radiance,
                 FieldSums& sums) {
  gather(
      receivers, [](size_t s) { return s; }, directions, rows, radiance, sums);
}

void addGathered(std::span<const FieldReceiver> receivers, std::span<const uint32_t> chosen,
                 const FieldDirections& directions, std::span<const PartnerRow> rows,
                 const PartnerRadiance& radiance, FieldSums& sums) {
  gather(
      receivers, [&](size_t s) { return chosen[s]; }, directions, rows, radiance, sums);
}

}  // namespace lamplighter
