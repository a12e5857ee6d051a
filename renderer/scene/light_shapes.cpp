#include "renderer/scene/light_shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace lamplighter {

namespace {

constexpr int kDiskSides = 64;
constexpr int kTubeSides = 32, kTubeRings = 8;
constexpr int kSphereSubdivisions = 3;  // 20 · 4³ = 1280 triangles

Primitive rectangle(const vec2& size) {
  Primitive p;
  const float x = 0.5f * size.x, y = 0.5f * size.y;
  p.positions = {{-x, -y, 0}, {-x, y, 0}, {x, y, 0}, {x, -y, 0}};
  p.normals.assign(4, vec3(0, 0, -1));
  p.uv0 = {{0, 1}, {0, 0}, {1, 0}, {1, 1}};
  p.indices = {0, 1, 2, 0, 2, 3};
  return p;
}

Primitive disk(float diameter) {
  Primitive p;
  // A regular n-gon of circumradius r has area n/2 · r² · sin(2π/n).
  const float step = 2.0f * kPi / kDiskSides;
  const float radius = 0.5f * diameter * std::sqrt(kPi / (0.5f * kDiskSides * std::sin(step)));
  p.positions.emplace_back(0.0f);
  p.uv0.emplace_back(0.5f, 0.5f);
  for (int i = 0; i < kDiskSides; ++i) {
    const vec2 d(std::cos(step * static_cast<float>(i)), std::sin(step * static_cast<float>(i)));
    p.positions.emplace_back(radius * d, 0.0f);
    p.uv0.emplace_back(0.5f + 0.5f * d.x, 0.5f - 0.5f * d.y);
    const uint32_t next = static_cast<uint32_t>((i + 1) % kDiskSides);
    p.indices.insert(p.indices.end(), {0u, next + 1, static_cast<uint32_t>(i) + 1});
  }
  p.normals.assign(p.positions.size(), vec3(0, 0, -1));
  return p;
}

// An icosahedron on the unit sphere, with each face split into four several times.
Primitive unitIcosphere() {
  Primitive p;
  const float t = 0.5f * (1.0f + std::sqrt(5.0f));
  for (const vec3& v : {vec3(-1, t, 0), vec3(1, t, 0), vec3(-1, -t, 0), vec3(1, -t, 0),
                        vec3(0, -1, t), vec3(0, 1, t), vec3(0, -1, -t), vec3(0, 1, -t),
                        vec3(t, 0, -1), vec3(t, 0, 1), vec3(-t, 0, -1), vec3(-t, 0, 1)}) {
    p.positions.push_back(glm::normalize(v));
  }
  p.indices = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
               4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
               6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
  for (int level = 0; level < kSphereSubdivisions; ++level) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [it, isNew] =
          middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(p.positions.size()));
      if (isNew) p.positions.push_back(glm::normalize(p.positions[a] + p.positions[b]));
      return it->second;
    };
    std::vector<uint32_t> finer;
    for (size_t i = 0; i < p.indices.size(); i += 3) {
      const uint32_t a = p.indices[i], b = p.indices[i + 1], c = p.indices[i + 2];
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    p.indices = std::move(finer);
  }
  return p;
}

Primitive sphere(float diameter) {
  Primitive p = unitIcosphere();
  double area = 0.0;
  for (size_t i = 0; i < p.indices.size(); i += 3) {
    const vec3 &a = p.positions[p.indices[i]], &b = p.positions[p.indices[i + 1]],
               &c = p.positions[p.indices[i + 2]];
    area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  const float radius =
      0.5f * diameter * static_cast<float>(std::sqrt(4.0 * static_cast<double>(kPi) / area));
  p.normals = p.positions;
  for (vec3& q : p.positions) q *= radius;
  p.uv0.assign(p.positions.size(), vec2(0.0f));
  return p;
}

// The lateral surface of a tube: a prism of the same area 2πrl. The perimeter of its polygon equals
// the circumference of the circle: n · 2R sin(π/n) = 2πr. It is also divided along its length, to
// avoid thin triangles.
Primitive tube(float length, float diameter) {
  Primitive p;
  const float half = kPi / static_cast<float>(kTubeSides);
  const float radius = 0.5f * diameter * half / std::sin(half);
  for (int ring = 0; ring <= kTubeRings; ++ring) {
    const float along = static_cast<float>(ring) / kTubeRings;
    for (int side = 0; side <= kTubeSides; ++side) {
      const float around = static_cast<float>(side) / kTubeSides;
      const float a = 2.0f * kPi * static_cast<float>(side % kTubeSides) / kTubeSides;
      const vec3 out(0.0f, std::cos(a), std::sin(a));
      p.positions.push_back(radius * out + vec3((along - 0.5f) * length, 0.0f, 0.0f));
      p.normals.push_back(out);
      p.uv0.emplace_back(along, around);
    }
  }
  for (uint32_t ring = 0; ring < kTubeRings; ++ring) {
    for (uint32_t side = 0; side < kTubeSides; ++side) {
      const uint32_t a = ring * (kTubeSides + 1) + side, b = a + 1;
      const uint32_t c = a + kTubeSides + 1, d = c + 1;
      p.indices.insert(p.indices.end(), {a, b, d, a, d, c});
    }
  }
  return p;
}

}  // namespace

Primitive tessellate(const AreaLight& light) {
  switch (light.shape) {
    case AreaShape::rectangle:
      return rectangle(light.size);
    case AreaShape::disk:
      return disk(light.size.x);
    case AreaShape::sphere:
      return sphere(light.size.x);
    case AreaShape::tube:
      return tube(light.size.x, light.size.y);
  }
  return {};
}

float areaOf(const AreaLight& light, const mat4& world) {
  const vec3 x(world[0]), y(world[1]), z(world[2]);
  switch (light.shape) {
    case AreaShape::rectangle:
      return glm::length(glm::cross(x, y)) * light.size.x * light.size.y;
    case AreaShape::disk:
      return glm::length(glm::cross(x, y)) * kPi * 0.25f * light.size.x * light.size.x;
    case AreaShape::sphere: {
      const float diameter =
          light.size.x * (glm::length(x) + glm::length(y) + glm::length(z)) / 3.0f;
      return kPi * diameter * diameter;
    }
    case AreaShape::tube: {
      const float diameter = light.size.y * (glm::length(y) + glm::length(z)) / 2.0f;
      return kPi * diameter * light.size.x * glm::length(x);
    }
  }
  return 0.0f;
}

float projectedAreaOf(const AreaLight& light, const mat4& world) {
  const float area = areaOf(light, world);
  if (light.shape == AreaShape::sphere) return 0.25f * area;
  return light.shape == AreaShape::tube ? area / kPi : area;
}

}  // namespace lamplighter
