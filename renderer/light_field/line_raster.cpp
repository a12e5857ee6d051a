#include "renderer/light_field/line_raster.h"

#include <algorithm>
#include <cmath>

#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

int firstCentreFrom(float x) { return static_cast<int>(std::ceil(x - 0.5f)); }

// Whether no cell centre lies between these.
bool isBetweenCentres(float a, float b, float c) {
  return std::ceil(std::min(a, std::min(b, c)) - 0.5f) ==
         std::ceil(std::max(a, std::max(b, c)) - 0.5f);
}

// Position of an edge at a row: equal for both triangles of the edge, so that no line passes
// between them or meets both.
float edgeAt(vec3 a, vec3 b, float y) {
  if (b.y < a.y || (b.y == a.y && b.x < a.x)) std::swap(a, b);
  return a.x + (y - a.y) * ((b.x - a.x) / (b.y - a.y));
}

// The linear function with these values at three points: its value at the origin and its slopes.
vec3 linearThrough(const std::array<vec3, 3>& p, float area, float v0, float v1, float v2) {
  const float d1 = v1 - v0, d2 = v2 - v0;
  const float x1 = p[1].x - p[0].x, y1 = p[1].y - p[0].y;
  const float x2 = p[2].x - p[0].x, y2 = p[2].y - p[0].y;
  const float dx = (d1 * y2 - d2 * y1) / area, dy = (x1 * d2 - x2 * d1) / area;
  return {v0 - dx * p[0].x - dy * p[0].y, dx, dy};
}

}  // namespace

void LineRaster::draw(const RenderScene& scene, const FieldSurface& surface, const LineGrid& grid) {
  grid_ = grid;
  triangles_.clear();
  runs_.clear();
  vec2 low(std::numeric_limits<float>::infinity()), high = -low;
  for (int k = 0; k < 8; ++k) {
    const vec3& a = scene.bounds.min;
    const vec3& b = scene.bounds.max;
    const vec3 p = grid.toGrid({k & 1 ? b.x : a.x, k & 2 ? b.y : a.y, k & 4 ? b.z : a.z});
    low = glm::min(low, vec2(p));
    high = glm::max(high, vec2(p));
  }
  low_ = glm::ivec2(glm::floor(low)) - 1;
  size_ = glm::max(glm::ivec2(glm::floor(high)) + 2 - low_, glm::ivec2(1));
  positions_.resize(scene.positions.size());
  for (size_t i = 0; i < positions_.size(); ++i) positions_[i] = grid.toGrid(scene.positions[i]);
  const auto corners = surface.corners();
  for (size_t t = 0; t < corners.size(); ++t) {
    const vec3 &a = positions_[corners[t][0]], &b = positions_[corners[t][1]],
               &c = positions_[corners[t][2]];
    if (isBetweenCentres(a.x, b.x, c.x) || isBetweenCentres(a.y, b.y, c.y)) continue;
    addTriangle(scene, surface.triangles()[t], {a, b, c});
  }

  const size_t cells = static_cast<size_t>(size_.x) * static_cast<size_t>(size_.y);
  const auto rowAt = [&](int row) {
    return static_cast<size_t>(row - low_.y) * static_cast<size_t>(size_.x) -
           static_cast<size_t>(low_.x);
  };
  starts_.assign(cells + 1, 0);
  for (const Run& run : runs_)
    for (int x = run.first; x < run.end; ++x) ++starts_[rowAt(run.row) + static_cast<size_t>(x)];
  uint32_t sum = 0;
  for (uint32_t& start : starts_) sum += std::exchange(start, sum);
  crossings_.resize(sum);
  // Filling moves each start to the next one's.
  for (const Run& run : runs_) {
    const vec3& depth = triangles_[run.triangle].depth;
    const float left = depth.x + depth.z * (static_cast<float>(run.row) + 0.5f);
    for (int x = run.first; x < run.end; ++x)
      crossings_[starts_[rowAt(run.row) + static_cast<size_t>(x)]++] = {
          left + depth.y * (static_cast<float>(x) + 0.5f), run.triangle};
  }
  for (size_t c = cells; c > 0; --c) starts_[c] = starts_[c - 1];
  starts_[0] = 0;
  const auto comesBefore = [](const LineCrossing& a, const LineCrossing& b) {
    return a.depth != b.depth ? a.depth < b.depth : a.triangle < b.triangle;
  };
  for (size_t c = 0; c < cells; ++c)
    if (starts_[c + 1] - starts_[c] > 1)
      std::sort(crossings_.begin() + starts_[c], crossings_.begin() + starts_[c + 1], comesBefore);
}

void LineRaster::addTriangle(const RenderScene& scene, const FieldSurface::Triangle& triangle,
                             const Corners& p) {
  const float area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
  if (!(std::abs(area) > 0.0f)) return;
  const auto number = static_cast<uint32_t>(triangles_.size());
  LineTriangle& out = triangles_.emplace_back();
  out.depth = linearThrough(p, area, p[0].z, p[1].z, p[2].z);
  out.object = triangle.object;
  out.hasTexels = triangle.hasTexels;
  out.facesAlong = area > 0.0f;
  if (triangle.hasTexels) {
    const auto& t = triangle.texels;
    const vec3 u = linearThrough(p, area, t[0].x, t[1].x, t[2].x);
    const vec3 v = linearThrough(p, area, t[0].y, t[1].y, t[2].y);
    for (int k = 0; k < 3; ++k) out.texels[static_cast<size_t>(k)] = {u[k], v[k]};
  }
  Corners byRow = p;
  std::ranges::sort(byRow, {}, &vec3::y);
  const int last = firstCentreFrom(byRow[2].y);
  for (int row = firstCentreFrom(byRow[0].y); row < last; ++row) {
    const float y = static_cast<float>(row) + 0.5f;
    const float side = edgeAt(byRow[0], byRow[2], y);
    const float other =
        y < byRow[1].y ? edgeAt(byRow[0], byRow[1], y) : edgeAt(byRow[1], byRow[2], y);
    Run run{row, firstCentreFrom(std::min(side, other)), firstCentreFrom(std::max(side, other)),
            number};
    if (run.first >= run.end) continue;
    if (triangle.isMasked)
      addMasked(scene, triangle, run, p);
    else
      runs_.push_back(run);
  }
}

// The parts of a run that are not holes of the alpha mask.
void LineRaster::addMasked(const RenderScene& scene, const FieldSurface::Triangle& triangle,
                           const Run& run, const Corners& p) {
  const float area = (p[1].x - p[0].x) * (p[2].y - p[0].y) - (p[2].x - p[0].x) * (p[1].y - p[0].y);
  const float cutoff =
      scene.materials[static_cast<size_t>(scene.objects[triangle.object].material)].alphaCutoff;
  const float y = static_cast<float>(run.row) + 0.5f - p[0].y;
  Run part = run;
  part.end = part.first;
  for (int x = run.first; x <= run.end; ++x) {
    bool isSolid = false;
    if (x < run.end) {
      const float dx = static_cast<float>(x) + 0.5f - p[0].x;
      const float u =
          std::clamp((dx * (p[2].y - p[0].y) - y * (p[2].x - p[0].x)) / area, 0.0f, 1.0f);
      const float v =
          std::clamp((y * (p[1].x - p[0].x) - dx * (p[1].y - p[0].y)) / area, 0.0f, 1.0f - u);
      isSolid = alphaAt(scene, triangle.object, triangle.triangle, u, v) >= cutoff;
    }
    if (isSolid) {
      part.end = x + 1;
      continue;
    }
    if (part.first < part.end) runs_.push_back(part);
    part.first = part.end = x + 1;
  }
}

std::span<const LineCrossing> LineRaster::at(int x, int y) const {
  const int column = x - low_.x, row = y - low_.y;
  if (column < 0 || row < 0 || column >= size_.x || row >= size_.y) return {};
  const size_t cell =
      static_cast<size_t>(row) * static_cast<size_t>(size_.x) + static_cast<size_t>(column);
  return {crossings_.data() + starts_[cell], crossings_.data() + starts_[cell + 1]};
}

}  // namespace lamplighter
