#include "renderer/patches/patch_set.h"

#include <algorithm>
#include <numeric>
#include <span>

namespace lamplighter {
namespace {

constexpr int kMostSplits = 6;
constexpr float kSmallest = 0.4f;  // m
constexpr size_t kClusterTriangles = 1024;

void splitRectangle(ObjectPatches& out, int index, int splits) {
  const Patch whole = out.patches[static_cast<size_t>(index)];
  const vec2 size = whole.max - whole.min;
  if (splits == 0 || std::max(size.x, size.y) < 2.0f * kSmallest) return;
  const int axis = size.y > size.x ? 1 : 0;
  const int first = static_cast<int>(out.patches.size());
  out.patches[static_cast<size_t>(index)].firstChild = first;
  out.patches[static_cast<size_t>(index)].axis = axis;
  const float middle = 0.5f * (whole.min[axis] + whole.max[axis]);
  Patch half = whole;
  half.max[axis] = middle;
  out.patches.push_back(half);
  half = whole;
  half.min[axis] = middle;
  out.patches.push_back(half);
  splitRectangle(out, first, splits - 1);
  splitRectangle(out, first + 1, splits - 1);
}

Bounds boundsOf(const RenderScene& s, const RenderObject& o, uint32_t triangle) {
  Bounds b;
  for (uint32_t c = 0; c < 3; ++c) b.add(s.positions[s.indices[o.firstIndex + 3 * triangle + c]]);
  return b;
}

// Halves triangles[first, last) by the median of their middles along the longest side.
void splitCluster(ObjectPatches& out, const RenderScene& s, const RenderObject& o, int index,
                  std::span<uint32_t> triangles) {
  Bounds box;
  for (const uint32_t t : triangles) box.add(boundsOf(s, o, t));
  out.patches[static_cast<size_t>(index)].box = box;
  if (triangles.size() <= kClusterTriangles) {
    for (const uint32_t t : triangles) out.patchOfTriangle[t] = index;
    return;
  }
  const vec3 size = box.extent();
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  std::stable_sort(triangles.begin(), triangles.end(), [&](uint32_t a, uint32_t b) {
    return boundsOf(s, o, a).centre()[axis] < boundsOf(s, o, b).centre()[axis];
  });
  const int first = static_cast<int>(out.patches.size());
  out.patches[static_cast<size_t>(index)].firstChild = first;
  out.patches.resize(out.patches.size() + 2);
  const size_t half = triangles.size() / 2;
  splitCluster(out, s, o, first, triangles.first(half));
  splitCluster(out, s, o, first + 1, triangles.subspan(half));
}

}  // namespace

int ObjectPatches::leafAt(uint32_t triangle, const vec3& position) const {
  int index = patchOfTriangle[triangle];
  const Patch* patch = &patches[static_cast<size_t>(index)];
  if (patch->chart == kNone) return index;
  const vec2 p = charts[static_cast<size_t>(patch->chart)].project(position);
  while (!patch->isLeaf()) {
    const float middle = 0.5f * (patch->min[patch->axis] + patch->max[patch->axis]);
    index = patch->firstChild + (p[patch->axis] < middle ? 0 : 1);
    patch = &patches[static_cast<size_t>(index)];
  }
  return index;
}

ObjectPatches makePatches(const RenderScene& scene, uint32_t object) {
  const RenderObject& o = scene.objects[object];
  ObjectPatches out;
  out.charts = findCharts(scene, object);
  out.patchOfTriangle.assign(o.triangleCount(), kNone);
  for (size_t i = 0; i < out.charts.size(); ++i) {
    const int root = static_cast<int>(out.patches.size());
    Patch patch;
    patch.chart = static_cast<int>(i);
    patch.min = out.charts[i].min;
    patch.max = out.charts[i].max;
    out.patches.push_back(patch);
    out.roots.push_back(root);
    for (const uint32_t t : out.charts[i].triangles) out.patchOfTriangle[t] = root;
    splitRectangle(out, root, kMostSplits);
  }
  std::vector<uint32_t> loose;
  for (uint32_t t = 0; t < o.triangleCount(); ++t)
    if (out.patchOfTriangle[t] == kNone) loose.push_back(t);
  if (loose.empty()) return out;
  const int root = static_cast<int>(out.patches.size());
  out.patches.emplace_back();
  out.roots.push_back(root);
  splitCluster(out, scene, o, root, loose);
  return out;
}

}  // namespace lamplighter
