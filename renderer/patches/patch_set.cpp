#include "renderer/patches/patch_set.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "renderer/patches/triangle_bounds.h"

namespace lamplighter {
namespace {

constexpr int kMostSplits = 7;
// Smallest length of both halves [m]. Smaller patches need fewer shadow map look-ups, but their
// additional entries cost more when a light moves: docs/results/performance.md, the visibility
// database.
constexpr float kSmallest = 0.6f;
// Factor by which a sphere is larger than those that it contains: more than rounding errors.
constexpr float kNested = 1.0001f;

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

// Children follow their parents.
void findLevels(ObjectPatches& out) {
  std::vector<size_t> levels(out.patches.size(), 0);
  for (size_t i = 0; i < out.patches.size(); ++i) {
    if (out.countAtLevel.size() <= levels[i]) out.countAtLevel.resize(levels[i] + 1, 0);
    ++out.countAtLevel[levels[i]];
    const int first = out.patches[i].firstChild;
    if (first == kNone) continue;
    for (const int child : {first, first + 1}) {
      out.patches[static_cast<size_t>(child)].parent = static_cast<int>(i);
      levels[static_cast<size_t>(child)] = levels[i] + 1;
    }
  }
}

// Computes bounding spheres of patches, and a tree over those of the roots. A sphere contains those
// of all patches below it, with a margin for rounding errors: what cannot reach a patch cannot
// reach its descendants.
void surround(ObjectPatches& out) {
  for (auto p = out.patches.rbegin(); p != out.patches.rend(); ++p) {
    if (p->chart == kNone) {
      p->centre = p->box.centre();
      p->radius = p->box.radius();
    } else {
      const Chart& chart = out.charts[static_cast<size_t>(p->chart)];
      p->centre = chart.at(0.5f * (p->min + p->max));
      p->radius = 0.5f * glm::length(p->max - p->min) + chart.thickness;
    }
    if (p->isLeaf()) continue;
    for (int child = p->firstChild; child < p->firstChild + 2; ++child) {
      const Patch& c = out.patches[static_cast<size_t>(child)];
      p->radius = std::max(p->radius, kNested * (glm::distance(p->centre, c.centre) + c.radius));
    }
  }
  std::vector<Bounds> boxes;
  for (const int root : out.roots) {
    const Patch& p = out.patches[static_cast<size_t>(root)];
    Bounds& box = boxes.emplace_back();
    box.add(p.centre - p.radius);
    box.add(p.centre + p.radius);
  }
  out.tree = BoundsTree(boxes);
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

ObjectPatches placePatches(const RenderScene& scene, uint32_t object,
                           const MeshTopology& topology) {
  const RenderObject& o = scene.objects[object];
  ObjectPatches out;
  out.revision.advance();
  out.bounds = o.bounds;
  const vec3 centre = o.bounds.centre();
  float radius2 = 0.0f;
  for (uint32_t i = 0; i < o.vertexCount; ++i) {
    const vec3 v = scene.positions[o.firstVertex + i] - centre;
    radius2 = std::max(radius2, glm::dot(v, v));
  }
  out.radius = std::sqrt(radius2);
  out.charts = placeCharts(scene, object, topology);
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
  const std::span<const uint32_t> loose(topology.loose);
  for (size_t i = 0; i < loose.size(); i += kGroupTriangles)
    out.groups.push_back(
        boundsOf(scene, o, loose.subspan(i, std::min(kGroupTriangles, loose.size() - i))));
  const int first = static_cast<int>(out.patches.size());
  if (!topology.clusters.empty()) out.roots.push_back(first);
  for (const ClusterTopology& cluster : topology.clusters) {
    const int index = static_cast<int>(out.patches.size());
    const std::span<const uint32_t> triangles(&topology.loose[cluster.first], cluster.count);
    Patch& patch = out.patches.emplace_back();
    if (cluster.firstChild != kNone) {
      patch.firstChild = first + cluster.firstChild;
    } else {
      // A cluster consists of whole groups.
      for (size_t i = 0; i < cluster.count; i += kGroupTriangles)
        patch.box.add(out.groups[(cluster.first + i) / kGroupTriangles]);
      for (const uint32_t t : triangles) out.patchOfTriangle[t] = index;
    }
  }
  for (size_t i = out.patches.size(); i-- > static_cast<size_t>(first);)
    if (const Patch& p = out.patches[i]; !p.isLeaf())
      for (int child = p.firstChild; child < p.firstChild + 2; ++child)
        out.patches[i].box.add(out.patches[static_cast<size_t>(child)].box);
  findLevels(out);
  surround(out);
  return out;
}

}  // namespace lamplighter
