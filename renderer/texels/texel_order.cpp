#include "renderer/texels/texel_order.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

namespace lamplighter {
namespace {

using Texels = std::span<const SurfaceTexel>;

float distance2(const SurfaceTexel& a, const SurfaceTexel& b) {
  const vec3 d = a.spot.position - b.spot.position;
  return glm::dot(d, d);
}

std::vector<uint32_t> zigzag(Texels texels, std::vector<uint32_t> chart) {
  std::ranges::sort(chart, {}, [&](uint32_t t) {
    const glm::ivec2 at = texels[t].at;
    return std::pair(at.y, at.y % 2 == 0 ? at.x : -at.x);
  });
  return chart;
}

// Follows the border with the left hand, then the visited texels. If no neighbour is free, it goes
// back.
std::vector<uint32_t> spiral(Texels texels, std::vector<uint32_t> chart) {
  std::map<std::pair<int, int>, uint32_t> isFree;  // by row and column
  for (const uint32_t t : chart) isFree[{texels[t].at.y, texels[t].at.x}] = t;
  constexpr std::array<glm::ivec2, 4> kWays{glm::ivec2(1, 0), {0, 1}, {-1, 0}, {0, -1}};
  std::vector<uint32_t> out;
  while (!isFree.empty()) {
    std::vector<std::pair<uint32_t, int>> path;  // texel, and the way to it
    const auto enter = [&](uint32_t t, int way) {
      isFree.erase({texels[t].at.y, texels[t].at.x});
      out.push_back(t);
      path.emplace_back(t, way);
    };
    enter(isFree.begin()->second, 0);
    while (!path.empty()) {
      const auto [t, way] = path.back();
      bool isStuck = true;
      for (const int turn : {3, 0, 1, 2}) {  // left, ahead, right, back
        const int next = (way + turn) % 4;
        const glm::ivec2 at = texels[t].at + kWays[static_cast<size_t>(next)];
        const auto it = isFree.find({at.y, at.x});
        if (it == isFree.end()) continue;
        enter(it->second, next);
        isStuck = false;
        break;
      }
      if (isStuck) path.pop_back();
    }
  }
  return out;
}

std::vector<uint32_t> greedy(Texels texels) {
  std::vector<uint32_t> left(texels.size()), out;
  for (uint32_t t = 0; t < left.size(); ++t) left[t] = t;
  uint32_t at = 0;
  while (!left.empty()) {
    const auto nearest = std::ranges::min_element(
        left, {}, [&](uint32_t t) { return std::pair(distance2(texels[t], texels[at]), t); });
    at = *nearest;
    out.push_back(at);
    *nearest = left.back();
    left.pop_back();
  }
  return out;
}

}  // namespace

std::vector<uint32_t> orderOf(Texels texels, TexelOrder order) {
  if (order == TexelOrder::greedy) return greedy(texels);
  std::vector<std::vector<uint32_t>> charts;
  for (uint32_t t = 0; t < texels.size(); ++t) {
    if (charts.size() <= texels[t].chart) charts.resize(texels[t].chart + 1);
    charts[texels[t].chart].push_back(t);
  }
  std::vector<uint32_t> out;
  size_t next = 0;
  for (size_t done = 0; done < charts.size(); ++done) {
    const std::vector<uint32_t> chart = std::exchange(charts[next], {});
    const auto ordered =
        order == TexelOrder::spiral ? spiral(texels, chart) : zigzag(texels, chart);
    out.insert(out.end(), ordered.begin(), ordered.end());
    float nearest = std::numeric_limits<float>::infinity();
    for (size_t c = 0; c < charts.size(); ++c) {
      for (const uint32_t t : charts[c]) {
        const float distance = distance2(texels[t], texels[out.back()]);
        if (distance >= nearest) continue;
        nearest = distance;
        next = c;
      }
    }
  }
  return out;
}

}  // namespace lamplighter
