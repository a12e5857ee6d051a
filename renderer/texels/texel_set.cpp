#include "renderer/texels/texel_set.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include <tbb/parallel_for.h>

#include "renderer/base/random.h"
#include "renderer/surface_light/gather_links.h"
#include "renderer/texels/texel_order.h"

namespace lamplighter {
namespace {

// Sample points along a side of a texel that estimate the area covered by a triangle.
constexpr int kPlaces = 4;
// Search radius for the nearest texel if a point lies between none [texels].
constexpr int kReach = kGutter + 1;

// Rays that find buried texels: a texel is buried if more than one in this number hits a back face
// within this many sides of the texel.
constexpr int kBuriedRays = 32, kBuriedShare = 8;
constexpr float kBuriedNear = 4.0f;
constexpr uint32_t kBuriedSet = 0x8b;

// A sample point of a texel on a triangle.
struct Covered {
  vec2 at;  // [texels]
  SurfacePlace place;
  float area = 0.0f;  // area that it represents [m²]
};

float crossOf(const vec2& a, const vec2& b) { return a.x * b.y - a.y * b.x; }

// A triangle in the rectangle of its chart [texels].
struct FlatTriangle {
  std::array<vec2, 3> corners;

  FlatTriangle(const RenderScene& scene, uint32_t object, const ObjectAtlas& own,
               const PlacedChart& placed, uint32_t triangle) {
    const uint32_t* i = &scene.indices[scene.objects[object].firstIndex + 3 * triangle];
    for (size_t k = 0; k < 3; ++k)
      corners[k] = placed.texelsOf(own.toOwn(scene.positions[i[k]])) - vec2(placed.at);
  }
  float doubledArea() const { return crossOf(corners[1] - corners[0], corners[2] - corners[0]); }
  // Weights of the second and third corner; none outside.
  std::optional<vec2> weightsOf(const vec2& p) const {
    const float area = doubledArea();
    const float u = crossOf(p - corners[0], corners[2] - corners[0]) / area;
    const float v = crossOf(corners[1] - corners[0], p - corners[0]) / area;
    // A point on an edge must not lie outside both triangles.
    constexpr float kRounding = 1e-4f;
    if (u < -kRounding || v < -kRounding || u + v > 1.0f + kRounding) return std::nullopt;
    const float second = std::clamp(u, 0.0f, 1.0f);
    return vec2(second, std::clamp(v, 0.0f, 1.0f - second));
  }
};

// The sample points of a chart, by texel of its rectangle.
struct ChartCover {
  ChartCover(const RenderScene& scene, uint32_t object, const ObjectAtlas& own,
             const PlacedChart& placed)
      : size(placed.size),
        places(static_cast<size_t>(size.x) * static_cast<size_t>(size.y)),
        isCovered(kPlaces * kPlaces * places.size(), false) {
    const RenderObject& o = scene.objects[object];
    for (const uint32_t triangle : placed.chart.triangles) {
      const uint32_t* i = &scene.indices[o.firstIndex + 3 * triangle];
      const vec3& a = scene.positions[i[0]];
      const float world =
          0.5f * glm::length(glm::cross(scene.positions[i[1]] - a, scene.positions[i[2]] - a));
      area += world;
      add(triangle, FlatTriangle(scene, object, own, placed, triangle), world);
    }
  }
  void add(uint32_t triangle, const FlatTriangle& flat, float world) {
    const float doubled = flat.doubledArea();
    if (doubled == 0.0f) return;
    const float share = world / (0.5f * std::abs(doubled)) / (kPlaces * kPlaces);
    const auto& t = flat.corners;
    const vec2 low = glm::min(t[0], glm::min(t[1], t[2]));
    const vec2 high = glm::max(t[0], glm::max(t[1], t[2]));
    const auto first = [](float x) { return std::max(0, static_cast<int>(x * kPlaces) - 1); };
    const int right = std::min(size.x * kPlaces, static_cast<int>(high.x * kPlaces) + 1);
    const int bottom = std::min(size.y * kPlaces, static_cast<int>(high.y * kPlaces) + 1);
    for (int y = first(low.y); y < bottom; ++y) {
      for (int x = first(low.x); x < right; ++x) {
        const vec2 p = (vec2(x, y) + 0.5f) / static_cast<float>(kPlaces);
        const auto weights = flat.weightsOf(p);
        if (!weights) continue;
        // A sample point on an edge belongs to one triangle.
        auto isTaken = isCovered[static_cast<size_t>(y) * static_cast<size_t>(kPlaces * size.x) +
                                 static_cast<size_t>(x)];
        if (isTaken) continue;
        isTaken = true;
        const auto texel = static_cast<size_t>(y / kPlaces * size.x + x / kPlaces);
        places[texel].push_back({p, {triangle, weights->x, weights->y}, share});
      }
    }
  }

  glm::ivec2 size;
  float area = 0.0f;  // of the chart [m²]
  std::vector<std::vector<Covered>> places;
  std::vector<bool> isCovered;  // by place
};

// Makes the texel from its covered sample points.
SurfaceTexel texelOf(const RenderScene& scene, uint32_t object, const ObjectAtlas& own,
                     const PlacedChart& placed, std::span<const Covered> places) {
  SurfaceTexel texel;
  texel.object = object;
  vec2 mean(0.0f);
  for (const Covered& c : places) {
    mean += c.at / static_cast<float>(places.size());
    texel.area += c.area;
  }
  // The sample point nearest to the mean, or the mean itself if it lies on a triangle.
  texel.place = std::ranges::min_element(places, {}, [&](const Covered& c) {
                  return glm::distance(c.at, mean);
                })->place;
  // If all are covered: one of each row of sample points, in different columns.
  constexpr std::array<size_t, 4> kColumns{1, 3, 0, 2};
  for (size_t k = 0; k < texel.spread.size(); ++k)
    texel.spread[k] =
        places[(kPlaces * k + kColumns[k]) * places.size() / (kPlaces * kPlaces)].place;
  uint32_t tried = texel.place.triangle + 1;
  for (const Covered& c : places) {
    if (c.place.triangle == tried) continue;
    tried = c.place.triangle;
    const auto weights = FlatTriangle(scene, object, own, placed, tried).weightsOf(mean);
    if (!weights) continue;
    texel.place = {tried, weights->x, weights->y};
    break;
  }
  texel.spot = spotAt(scene, object, texel.place);
  // The axes of the chart, in the plane of the triangle.
  const mat3& turn = own.space.rotation;
  const vec3 up = turn * placed.chart.normal, n = texel.spot.geometricNormal;
  const float slope = glm::dot(up, n);
  const std::array<vec3, 2> axes{turn * placed.chart.tangent, turn * placed.chart.bitangent};
  for (size_t k = 0; k < 2; ++k)
    texel.half[k] = axes[k] - (slope != 0.0f ? glm::dot(axes[k], n) / slope : 0.0f) * up;
  // A texel at the border of a chart may be narrow.
  vec2 low = places.front().at, high = low;
  for (const Covered& c : places) {
    low = glm::min(low, c.at);
    high = glm::max(high, c.at);
  }
  const vec2 extent = static_cast<float>(kPlaces) * (high - low) + 1.0f;  // in places
  if (extent.x * extent.y < static_cast<float>(places.size()) + 0.5f)
    for (int k = 0; k < 2; ++k) texel.half[static_cast<size_t>(k)] *= extent[k];
  return texel;
}

// Scales the rectangle of a texel to its area.
void sizeRectangle(SurfaceTexel& texel) {
  const float unit = glm::length(glm::cross(texel.half[0], texel.half[1]));
  const float side = unit > 0.0f ? 0.5f * std::sqrt(texel.area / unit) : 0.0f;
  for (vec3& h : texel.half) h *= side;
}

std::vector<SurfaceTexel> texelsOf(const RenderScene& scene, uint32_t object,
                                   const ObjectAtlas& own) {
  std::vector<SurfaceTexel> texels;
  for (uint32_t chart = 0; chart < own.atlas->charts.size(); ++chart) {
    const PlacedChart& placed = own.atlas->charts[chart];
    const ChartCover cover(scene, object, own, placed);
    const size_t first = texels.size();
    float covered = 0.0f;
    for (int y = 0; y < cover.size.y; ++y) {
      for (int x = 0; x < cover.size.x; ++x) {
        const auto& places = cover.places[static_cast<size_t>(y * cover.size.x + x)];
        if (places.empty()) continue;
        SurfaceTexel& texel = texels.emplace_back(texelOf(scene, object, own, placed, places));
        texel.at = placed.at + glm::ivec2(x, y);
        covered += texel.area;
      }
    }
    if (texels.size() == first) {  // smaller than a place
      const Covered middle{vec2(0.0f), {placed.chart.triangles.front(), 1.0f / 3, 1.0f / 3}, 1.0f};
      texels.push_back(texelOf(scene, object, own, placed, std::span(&middle, 1)));
      texels.back().at = placed.at + placed.size / 2;
      covered = 1.0f;
    }
    for (size_t i = first; i < texels.size(); ++i) {
      texels[i].chart = chart;
      texels[i].area *= cover.area / covered;
      sizeRectangle(texels[i]);
    }
  }
  return texels;
}

// The same texel on the back of the surface.
SurfaceTexel turned(const RenderScene& scene, SurfaceTexel texel) {
  const uint32_t behind = scene.objects[texel.object].triangleCount();
  texel.place.triangle += behind;
  for (SurfacePlace& place : texel.spread) place.triangle += behind;
  texel.spot = spotAt(scene, texel.object, texel.place);
  texel.half[0] = -texel.half[0];
  return texel;
}

}  // namespace

uint32_t seedOf(const SurfaceTexel& texel) {
  const vec3& p = texel.spot.position;
  return hash4(std::bit_cast<uint32_t>(p.x), std::bit_cast<uint32_t>(p.y),
               std::bit_cast<uint32_t>(p.z), texel.place.triangle);
}

TexelSet::TexelSet(const RenderScene& scene, std::span<const ObjectAtlas> atlases, TexelOrder order)
    : parts_(2 * atlases.size()) {
  std::vector<std::vector<SurfaceTexel>> bySide(parts_.size());
  tbb::parallel_for(size_t{0}, atlases.size(), [&](size_t o) {
    if (!atlases[o].atlas) return;
    const auto object = static_cast<uint32_t>(o);
    // Rays go through clear surfaces.
    if (scene.materials[static_cast<size_t>(scene.objects[o].material)].isClear()) return;
    const std::vector<SurfaceTexel> texels = texelsOf(scene, object, atlases[o]);
    for (const uint32_t t : orderOf(texels, order)) bySide[2 * o].push_back(texels[t]);
    if (scene.backIsUnseen(object)) return;
    for (const SurfaceTexel& t : bySide[2 * o]) bySide[2 * o + 1].push_back(turned(scene, t));
  });
  for (size_t side = 0; side < bySide.size(); ++side) {
    if (bySide[side].empty()) continue;
    Part& part = parts_[side];
    part.first = static_cast<uint32_t>(texels_.size());
    part.count = static_cast<uint32_t>(bySide[side].size());
    part.size = atlases[side / 2].atlas->size;
    part.texelAt.assign(static_cast<size_t>(part.size.x) * static_cast<size_t>(part.size.y), kNone);
    for (uint32_t k = 0; k < part.count; ++k) {
      const SurfaceTexel& t = bySide[side][k];
      part.texelAt[static_cast<size_t>(t.at.y * part.size.x + t.at.x)] = part.first + k;
      texels_.push_back(t);
    }
  }
}

uint64_t TexelSet::findBuried(const RenderScene& scene, const RayCaster& rays) {
  const std::vector<vec3> directions = gatherDirections(kBuriedRays, kBuriedSet);
  isBuried_.assign(texels_.size(), 0);
  tbb::parallel_for(size_t{0}, texels_.size(), [&](size_t t) {
    const SurfaceSpot& spot = texels_[t].spot;
    const float near = kBuriedNear * std::sqrt(texels_[t].area);
    int inside = 0;
    for (const vec3& d : directions) {
      const Ray ray{spot.rayOrigin(), 0.0f, gatherDirection(spot, d), near};
      if (ray.direction == vec3(0.0f)) continue;
      const Hit hit = rays.intersect(ray);
      if (hit && scene.backIsUnseen(hit.object) && isOnBack(scene, hit, ray.direction)) ++inside;
    }
    isBuried_[t] = kBuriedShare * inside > kBuriedRays ? 1 : 0;
  });
  return texels_.size() * static_cast<uint64_t>(kBuriedRays);
}

uint32_t TexelSet::texelAt(uint32_t object, bool isBack, const vec2& texels) const {
  const Part& part = parts_[2 * object + (isBack ? 1 : 0)];
  const auto x = static_cast<int>(std::floor(texels.x)), y = static_cast<int>(std::floor(texels.y));
  if (x < 0 || y < 0 || x >= part.size.x || y >= part.size.y) return kNone;
  return part.texelAt[static_cast<size_t>(y * part.size.x + x)];
}

TexelBlend TexelSet::blendAt(uint32_t object, bool isBack, const vec2& texels) const {
  const Part& part = parts_[2 * object + (isBack ? 1 : 0)];
  if (part.count == 0) return {};
  const TexelBlend shown = blendOf(part, texels, false);
  return shown.isAny() ? shown : blendOf(part, texels, true);
}

// The bilinear blend at a point; if that has no texel, the nearest one within kReach. `withBuried`:
// also buried ones.
TexelBlend TexelSet::blendOf(const Part& part, const vec2& texels, bool withBuried) const {
  TexelBlend blend;
  const auto at = [&](int x, int y) {
    const bool isIn = x >= 0 && y >= 0 && x < part.size.x && y < part.size.y;
    const uint32_t texel = isIn ? part.texelAt[static_cast<size_t>(y * part.size.x + x)] : kNone;
    return texel != kNone && !withBuried && isBuried(texel) ? kNone : texel;
  };
  const vec2 s = texels - 0.5f;
  const glm::ivec2 low(static_cast<int>(std::floor(s.x)), static_cast<int>(std::floor(s.y)));
  const vec2 f = s - vec2(low);
  float sum = 0.0f;
  for (int k = 0; k < 4; ++k) {
    const uint32_t texel = at(low.x + k % 2, low.y + k / 2);
    const float w = (k % 2 == 1 ? f.x : 1.0f - f.x) * (k / 2 == 1 ? f.y : 1.0f - f.y);
    if (texel == kNone) continue;
    blend.texels[static_cast<size_t>(k)] = texel;
    blend.weights[static_cast<size_t>(k)] = w;
    sum += w;
  }
  if (sum > 1e-3f) {
    for (float& w : blend.weights) w /= sum;
    return blend;
  }
  blend.weights = {};
  float nearest = std::numeric_limits<float>::infinity();
  for (int y = low.y - kReach + 1; y <= low.y + kReach; ++y) {
    for (int x = low.x - kReach + 1; x <= low.x + kReach; ++x) {
      const uint32_t texel = at(x, y);
      const float distance = glm::distance(vec2(x, y), s);
      if (texel == kNone || distance >= nearest) continue;
      nearest = distance;
      blend.texels[0] = texel;
      blend.weights[0] = 1.0f;
    }
  }
  return blend;
}

}  // namespace lamplighter
