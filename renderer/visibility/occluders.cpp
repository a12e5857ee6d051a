#include "renderer/visibility/occluders.h"

#include <algorithm>

namespace lamplighter {
namespace {

// Only walls and the like are tried as hiding a whole patch. In m².
constexpr float kLargePolygon = 1.0f;

}  // namespace

void Occluders::rebuild(const RenderScene& s, uint32_t index, const ObjectPatches& patches) {
  const RenderObject& o = s.objects[index];
  Object& object = objects_[index];
  object = Object();
  const Material& material = s.materials[static_cast<size_t>(o.material)];
  if (material.isClear()) return;
  std::vector<Bounds> boxes(o.triangleCount());
  for (uint32_t t = 0; t < o.triangleCount(); ++t)
    for (uint32_t c = 0; c < 3; ++c) boxes[t].add(s.positions[s.indices[o.firstIndex + 3 * t + c]]);
  object.triangles = BoundsTree(boxes);
  if (material.alphaMode == AlphaMode::mask) return;  // has holes
  boxes.clear();
  for (const Chart& chart : patches.charts) {
    if (chart.outline.empty() || chart.area < kLargePolygon) continue;
    object.polygons.push_back({chart.outline, chart.normal});
    Bounds& box = boxes.emplace_back();
    for (const vec3& corner : chart.outline) box.add(corner);
  }
  object.polygonTree = BoundsTree(boxes);
}

void Occluders::finish(const RenderScene& s) {
  std::vector<Bounds> boxes(s.objects.size());
  for (size_t i = 0; i < boxes.size(); ++i) boxes[i] = s.objects[i].bounds;
  tree_ = BoundsTree(boxes);
}

void Occluders::build(const RenderScene& s, const std::vector<ObjectPatches>& patches) {
  objects_.assign(s.objects.size(), {});
  for (uint32_t i = 0; i < objects_.size(); ++i) rebuild(s, i, patches[i]);
  finish(s);
}

bool Occluders::meets(const RenderScene& s, const OcclusionPyramid& pyramid,
                      uint32_t object) const {
  const RenderObject& o = s.objects[object];
  return !objects_[object].triangles.visit(
      [&](const Bounds& b) { return pyramid.mayMeet(b); },
      [&](uint32_t t) {
        const uint32_t* i = &s.indices[o.firstIndex + 3 * t];
        return !pyramid.meets(s.positions[i[0]], s.positions[i[1]], s.positions[i[2]]);
      });
}

bool Occluders::hides(const OcclusionPyramid& pyramid, uint32_t object) const {
  return !objects_[object].polygonTree.visit(
      [&](const Bounds& b) { return pyramid.mayMeet(b); },
      [&](uint32_t p) {
        const Polygon& polygon = objects_[object].polygons[p];
        return !pyramid.isCutBy(polygon.corners, polygon.normal);
      });
}

Occlusion Occluders::occlusionWithout(const RenderScene& s, const OcclusionPyramid& pyramid,
                                      std::span<const uint32_t> objects) const {
  if (pyramid.isDark()) return Occlusion::full;
  if (pyramid.isDegenerate()) return Occlusion::partial;
  const auto counts = [&](uint32_t i) {
    return std::find(objects.begin(), objects.end(), i) == objects.end();
  };
  const auto enter = [&](const Bounds& b) { return pyramid.mayMeet(b); };
  const bool isMet =
      !tree_.visit(enter, [&](uint32_t i) { return !(counts(i) && meets(s, pyramid, i)); });
  if (!isMet) return Occlusion::none;
  const bool isHidden =
      !tree_.visit(enter, [&](uint32_t i) { return !(counts(i) && hides(pyramid, i)); });
  return isHidden ? Occlusion::full : Occlusion::partial;
}

Occlusion Occluders::occlusionBy(const RenderScene& s, const OcclusionPyramid& pyramid,
                                 std::span<const uint32_t> objects) const {
  if (pyramid.isDark()) return Occlusion::full;
  if (pyramid.isDegenerate()) return Occlusion::partial;
  Occlusion state = Occlusion::none;
  for (const uint32_t i : objects) {
    if (!pyramid.mayMeet(s.objects[i].bounds) || !meets(s, pyramid, i)) continue;
    if (hides(pyramid, i)) return Occlusion::full;
    state = Occlusion::partial;
  }
  return state;
}

}  // namespace lamplighter
