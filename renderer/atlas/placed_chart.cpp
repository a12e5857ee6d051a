#include "renderer/atlas/placed_chart.h"

#include <algorithm>
#include <optional>
#include <vector>

namespace lamplighter {

void setDensity(PlacedChart& chart, float texelsPerMetre) {
  chart.texelsPerMetre = texelsPerMetre;
  // Rounds up to whole texels, with a tolerance.
  const vec2 texels = glm::ceil(texelsPerMetre * chart.chart.extent() - 1e-3f);
  chart.size = glm::ivec2(glm::max(texels, vec2(1.0f))) + 2 * kGutter;
}

bool placeOn(Skyline& page, std::span<PlacedChart* const> charts) {
  Skyline tried = page;
  std::vector<PlacedChart*> order(charts.begin(), charts.end());
  std::stable_sort(order.begin(), order.end(), [](const PlacedChart* a, const PlacedChart* b) {
    return a->size.y > b->size.y;
  });
  for (PlacedChart* chart : order) {
    const std::optional<glm::ivec2> at = tried.place(chart->size);
    if (!at) return false;
    chart->at = *at;
  }
  page = std::move(tried);
  return true;
}

}  // namespace lamplighter
