// Gathers the light that texels receive from their partners.
#pragma once

#include <span>
#include <vector>

#include "renderer/light_field/field_partners.h"

namespace lamplighter {

// xyz: the sum of weight × cosine × radiance; w: of weight × cosine.
using FieldSums = std::vector<vec4>;

// Radiance of partners [W/(m² sr)], by PartnerNumbers.
using PartnerRadiance = std::vector<vec4>;

// The partners of all receivers in a direction.
struct PartnerRow {
  uint32_t direction = 0;
  const uint32_t* partners = nullptr;  // by receiver
};

// Adds the light of some directions to the sums of all receivers.
void addGathered(std::span<const FieldReceiver> receivers, const FieldDirections& directions,
                 std::span<const PartnerRow> rows, const PartnerRadiance& radiance,
                 FieldSums& sums);
// The same for some of the receivers only: sums by index in `chosen`.
void addGathered(std::span<const FieldReceiver> receivers, std::span<const uint32_t> chosen,
                 const FieldDirections& directions, std::span<const PartnerRow> rows,
                 const PartnerRadiance& radiance, FieldSums& sums);

// Irradiance [W/m²]: normalised by the sum of cosines, so that uniform light L gives exactly πL
// with any number of directions. 0 without directions.
inline vec3 irradianceOf(const vec4& sum) {
  return sum.w > 0.0f ? (kPi / sum.w) * vec3(sum) : vec3(0.0f);
}

}  // namespace lamplighter
