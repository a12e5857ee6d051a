#include "renderer/prt/prt_memory.h"

#include <algorithm>
#include <numeric>

#include "renderer/prt/transfer_validation.h"

namespace lamplighter {
namespace {

// Per check point: three vertices, each of which blends kBlended light points.
constexpr size_t kMostTerms = 3 * IncidentLightPoints::kBlended;

}  // namespace

size_t mostBytesOf(const PrtNeeds& needs) {
  const size_t perVertex =
      sizeof(Transfer::Vertex) + sizeof(IncidentLightPoints::Blend) + sizeof(vec3);
  // Three channels of coefficients, for all light and for direct light; one byte per light.
  const size_t perPoint = size_t{2} * 3 * kShCoefficients * sizeof(double) + needs.slots;
  const size_t checks = validationPointsFor(needs.points);
  const size_t perCheck = sizeof(ValidationPoint) + kMostTerms * sizeof(ValidationPoint::Term) +
                          (needs.isChecked ? needs.slots * sizeof(LightError) : 0);
  return needs.vertices * perVertex + needs.points * perPoint + checks * perCheck +
         needs.slots * sizeof(LightErrors);
}

std::vector<bool> fitting(std::span<const size_t> bytes, size_t room) {
  std::vector<size_t> order(bytes.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return bytes[a] < bytes[b]; });
  std::vector<bool> out(bytes.size(), false);
  for (const size_t i : order) {
    if (bytes[i] > room) break;
    room -= bytes[i];
    out[i] = true;
  }
  return out;
}

}  // namespace lamplighter
