#include "renderer/surface_light/triangle_division.h"

#include <algorithm>
#include <initializer_list>
#include <limits>
#include <tuple>

namespace lamplighter {
namespace {

using Child = std::array<uint8_t, 3>;

TriangleDivision divided(std::initializer_list<Child> children) {
  constexpr std::array<std::array<float, 3>, 6> kPoints{
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.5f, 0.5f, 0}, {0, 0.5f, 0.5f}, {0.5f, 0, 0.5f}}};
  TriangleDivision out;
  for (const Child& child : children) {
    mat3 corners;
    for (int c = 0; c < 3; ++c) {
      const auto& p = kPoints[child[static_cast<size_t>(c)]];
      corners[c] = vec3(p[0], p[1], p[2]);
    }
    out.toChild[static_cast<size_t>(out.count)] = glm::inverse(corners);
    out.children[static_cast<size_t>(out.count++)] = child;
  }
  return out;
}

std::array<TriangleDivision, kDivisions> allDivisions() {
  std::array<TriangleDivision, kDivisions> all;
  for (const bool diagonal : {false, true}) {
    const auto set = [&](int edges, std::initializer_list<Child> first,
                         std::initializer_list<Child> second) {
      all[static_cast<size_t>(divisionOf(edges, diagonal))] = divided(diagonal ? second : first);
    };
    const std::initializer_list<Child> quarters{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}};
    set(1, {{0, 3, 2}, {3, 1, 2}}, {{0, 3, 2}, {3, 1, 2}});
    set(2, {{0, 1, 4}, {0, 4, 2}}, {{0, 1, 4}, {0, 4, 2}});
    set(4, {{0, 1, 5}, {5, 1, 2}}, {{0, 1, 5}, {5, 1, 2}});
    set(3, {{3, 1, 4}, {0, 3, 4}, {0, 4, 2}}, {{3, 1, 4}, {0, 3, 2}, {3, 4, 2}});
    set(6, {{5, 4, 2}, {0, 1, 4}, {0, 4, 5}}, {{5, 4, 2}, {0, 1, 5}, {1, 4, 5}});
    set(5, {{0, 3, 5}, {3, 1, 2}, {3, 2, 5}}, {{0, 3, 5}, {3, 1, 5}, {1, 2, 5}});
    set(7, quarters, quarters);
  }
  return all;
}

// The child in which the smallest weight is largest.
int nearestChild(const TriangleDivision& division, vec3& weights) {
  int best = 0;
  float least = -std::numeric_limits<float>::infinity();
  vec3 inBest = weights;
  for (int i = 0; i < division.count; ++i) {
    const vec3 w = division.toChild[static_cast<size_t>(i)] * weights;
    const float smallest = std::min({w.x, w.y, w.z});
    if (smallest <= least) continue;
    least = smallest;
    best = i;
    inBest = w;
    if (least >= 0.0f) break;
  }
  weights = inBest;
  return best;
}

}  // namespace

const TriangleDivision& triangleDivision(int division) {
  static const std::array<TriangleDivision, kDivisions> all = allDivisions();
  return all[static_cast<size_t>(division)];
}

int childAt(int division, vec3& weights) {
  const auto [x, y, z] = std::tuple(weights.x, weights.y, weights.z);
  const auto take = [&](int child, const vec3& w) {
    weights = w;
    return child;
  };
  // The most frequent divisions in closed form, because each ray needs several.
  switch (division & 7) {
    case 1:
      return x >= y ? take(0, {x - y, 2.0f * y, z}) : take(1, {2.0f * x, y - x, z});
    case 2:
      return y >= z ? take(0, {x, y - z, 2.0f * z}) : take(1, {x, 2.0f * y, z - y});
    case 4:
      return x >= z ? take(0, {x - z, y, 2.0f * z}) : take(1, {2.0f * x, y, z - x});
    case 7:
      if (x >= 0.5f) return take(0, {x - y - z, 2.0f * y, 2.0f * z});
      if (y >= 0.5f) return take(1, {2.0f * x, y - x - z, 2.0f * z});
      if (z >= 0.5f) return take(2, {2.0f * x, 2.0f * y, z - x - y});
      return take(3, {x + y - z, y + z - x, x + z - y});
    default:
      return nearestChild(triangleDivision(division), weights);
  }
}

}  // namespace lamplighter
