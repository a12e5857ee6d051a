#include "renderer/sampling/emitters/emitter_cells.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/scene/surface.h"

namespace lamplighter {

namespace {

// Upper limit of the cells of one object; if it has more triangles, one cell per triangle.
constexpr float kCells = 8192.0f;
constexpr int kFinest = 6;
// Fraction of the mean brightness that is added to each cell. The sample points may have missed a
// bright spot in a cell, and a density of zero there would be a bias.
constexpr double kFloor = 1.0 / 32.0;

// A part of a triangle in barycentric weights of the second and third vertex: its first corner and
// the signed length of its sides. They are parallel to the sides of the triangle, or opposite in a
// middle part.
struct Part {
  vec2 corner{0.0f};
  float side = 1.0f;  // signed

  // 0: part at the first corner, 1: the middle part, 2 and 3: parts at the other corners.
  Part child(uint32_t i) const {
    const float half = 0.5f * side;
    switch (i) {
      case 1:
        return {corner + vec2(half), -half};
      case 2:
        return {corner + vec2(half, 0.0f), half};
      case 3:
        return {corner + vec2(0.0f, half), half};
      default:
        return {corner, half};
    }
  }
  vec2 at(vec2 weights) const { return corner + side * weights; }
};

// Part `index` of 4^level.
Part partOf(uint32_t index, int level) {
  Part part;
  for (int shift = 2 * level - 2; shift >= 0; shift -= 2) part = part.child((index >> shift) & 3u);
  return part;
}

// The index of the part that contains a point.
uint32_t indexOf(vec2 w, int level) {
  uint32_t index = 0;
  for (int i = 0; i < level; ++i) {
    w *= 2.0f;
    if (w.x >= 1.0f) {
      index = 4 * index + 2, w.x -= 1.0f;
    } else if (w.y >= 1.0f) {
      index = 4 * index + 3, w.y -= 1.0f;
    } else if (w.x + w.y > 1.0f) {
      index = 4 * index + 1, w = vec2(1.0f) - w;
    } else {
      index = 4 * index;
    }
  }
  return index;
}

constexpr uint32_t partsAt(int level) { return 1u << (2 * level); }

// Hash of all inputs of the cells, over words so that it is fast at each edit.
class ContentHash {
 public:
  void add(uint32_t word) {
    value_ = (value_ ^ word) * 0x9e3779b97f4a7c15ull;
    value_ ^= value_ >> 29;
  }
  void add(float f) { add(std::bit_cast<uint32_t>(f)); }
  void add(const vec2& v) { add(v.x), add(v.y); }
  void add(const vec3& v) { add(v.x), add(v.y), add(v.z); }
  void add(const TextureRef& ref, const RenderScene& s) {
    const Texture& t = s.textures[static_cast<size_t>(ref.texture)];
    add(static_cast<uint32_t>(t.wrapS)), add(static_cast<uint32_t>(t.wrapT));
    add(static_cast<uint32_t>(t.nearest)), add(static_cast<uint32_t>(ref.texCoord));
    add(ref.offset), add(ref.rotation), add(ref.scale);
  }
  uint64_t value() const { return value_; }

 private:
  uint64_t value_ = 0x243f6a8885a308d3ull;
};

// Null if the reference has no texture.
std::shared_ptr<const Image8> imageOf(const RenderScene& s, const TextureRef& ref) {
  if (ref.texture == kNone) return nullptr;
  return s.textures[static_cast<size_t>(ref.texture)].image;
}

const Material& materialOf(const RenderScene& s, uint32_t object) {
  return s.materials[static_cast<size_t>(s.objects[object].material)];
}

std::shared_ptr<const Image8> maskOf(const RenderScene& s, const Material& m) {
  return m.alphaMode == AlphaMode::mask ? imageOf(s, m.baseColorTexture) : nullptr;
}

uint64_t contentOf(const RenderScene& s, uint32_t object) {
  const RenderObject& o = s.objects[object];
  const Material& m = materialOf(s, object);
  const bool isMasked = m.alphaMode == AlphaMode::mask;
  ContentHash h;
  h.add(o.vertexCount), h.add(o.indexCount);
  if (m.emissiveTexture.texture != kNone) h.add(m.emissiveTexture, s);
  if (isMasked) {
    h.add(m.alphaCutoff), h.add(m.baseColor.a);
    if (m.baseColorTexture.texture != kNone) h.add(m.baseColorTexture, s);
  }
  for (uint32_t i = o.firstIndex; i < o.firstIndex + o.indexCount; ++i)
    h.add(s.indices[i] - o.firstVertex);
  for (uint32_t v = o.firstVertex; v < o.firstVertex + o.vertexCount; ++v) {
    h.add(s.localPositions[v]), h.add(s.uv0[v]), h.add(s.uv1[v]);
    if (isMasked) h.add(s.colors[v].a);
  }
  return h.value();
}

}  // namespace

vec2 sampleTriangle(vec2 u) {
  const float root = std::sqrt(u.x);
  return {u.y * root, 1.0f - root};
}

CellBrightness::Key::Key(const RenderScene& s, uint32_t object)
    : content(contentOf(s, object)),
      emission(imageOf(s, materialOf(s, object).emissiveTexture)),
      mask(maskOf(s, materialOf(s, object))) {}

CellBrightness::CellBrightness(const RenderScene& s, uint32_t object, Key of) : key(std::move(of)) {
  const RenderObject& o = s.objects[object];
  const uint32_t count = o.triangleCount();
  // Areas in object space, so that moving and rotating the object changes no cell.
  std::vector<float> share(count);
  double sum = 0.0;
  for (uint32_t t = 0; t < count; ++t) {
    const uint32_t* i = &s.indices[o.firstIndex + 3 * t];
    const vec3& a = s.localPositions[i[0]];
    share[t] = glm::length(glm::cross(s.localPositions[i[1]] - a, s.localPositions[i[2]] - a));
    sum += static_cast<double>(share[t]);
  }
  const float perSum = sum > 0.0 ? static_cast<float>(1.0 / sum) : 0.0f;
  levels.resize(count);
  first.resize(count);
  for (uint32_t t = 0; t < count; ++t) {
    share[t] *= perSum;
    while (levels[t] < kFinest && static_cast<float>(partsAt(levels[t] + 1)) <= share[t] * kCells)
      ++levels[t];
    first[t] = static_cast<uint32_t>(triangle.size());
    triangle.insert(triangle.end(), partsAt(levels[t]), t);
  }
  luminance.resize(triangle.size());
  mean.resize(count);
  tbb::parallel_for(0u, count, [&](uint32_t t) {
    const int level = levels[t], finer = share[t] * kCells >= 1.0f ? 2 : 1;
    const uint32_t cells = partsAt(level), points = partsAt(finer);
    glm::dvec3 whole(0.0);
    for (uint32_t cell = 0; cell < cells; ++cell) {
      vec3 here(0.0f);
      for (uint32_t p = 0; p < points; ++p) {
        const vec2 at = partOf(cell * points + p, level + finer).at(vec2(1.0f / 3.0f));
        here += emissionShareAt(s, object, t, at.x, at.y);
      }
      here /= static_cast<float>(points);
      luminance[first[t] + cell] = lamplighter::luminance(here);
      whole += glm::dvec3(here);
    }
    mean[t] = vec3(whole / static_cast<double>(cells));
  });
}

EmitterCells::EmitterCells(std::shared_ptr<const CellBrightness> brightness,
                           std::span<const float> areas)
    : brightness_(std::move(brightness)) {
  const CellBrightness& b = *brightness_;
  cellArea_.resize(areas.size());
  double flux = 0.0, whole = 0.0;
  for (size_t t = 0; t < areas.size(); ++t) {
    cellArea_[t] = areas[t] / static_cast<float>(partsAt(b.levels[t]));
    whole += static_cast<double>(areas[t]);
  }
  for (size_t i = 0; i < b.luminance.size(); ++i)
    flux += static_cast<double>(cellArea_[b.triangle[i]]) * static_cast<double>(b.luminance[i]);
  const double least = whole > 0.0 ? kFloor * flux / whole : 0.0;
  upTo_.resize(b.luminance.size());
  double sum = 0.0;
  for (size_t i = 0; i < upTo_.size(); ++i) {
    sum += static_cast<double>(cellArea_[b.triangle[i]]) *
           (static_cast<double>(b.luminance[i]) + least);
    upTo_[i] = sum;
  }
  if (!(sum > 0.0)) *this = EmitterCells();
}

EmitterCells::Point EmitterCells::sample(vec2 u) const {
  constexpr float kBelowOne = 0x1.fffffep-1f;
  const double target = static_cast<double>(u.x) * upTo_.back();
  auto it = std::upper_bound(upTo_.begin(), upTo_.end(), target);
  if (it == upTo_.end())  // due to rounding errors: use the last cell with a non-zero weight
    it = std::lower_bound(upTo_.begin(), upTo_.end(), upTo_.back());
  const auto cell = static_cast<size_t>(it - upTo_.begin());
  const double below = cell == 0 ? 0.0 : upTo_[cell - 1];
  const float rest =
      std::clamp(static_cast<float>((target - below) / (*it - below)), 0.0f, kBelowOne);
  Point p;
  p.triangle = brightness_->triangle[cell];
  const auto index = static_cast<uint32_t>(cell) - brightness_->first[p.triangle];
  p.weights = partOf(index, brightness_->levels[p.triangle]).at(sampleTriangle({rest, u.y}));
  p.area = areaOf(cell);
  return p;
}

float EmitterCells::areaAt(uint32_t triangle, vec2 weights) const {
  return areaOf(brightness_->first[triangle] + indexOf(weights, brightness_->levels[triangle]));
}

float EmitterCells::areaOf(size_t cell) const {
  const double weight = upTo_[cell] - (cell == 0 ? 0.0 : upTo_[cell - 1]);
  const double area = static_cast<double>(cellArea_[brightness_->triangle[cell]]);
  return static_cast<float>(area * upTo_.back() / weight);
}

}  // namespace lamplighter
