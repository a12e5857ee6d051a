#include "renderer/visibility/occluders.h"

namespace lamplighter {

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
  object.polygonOf.assign(o.triangleCount(), kNone);
  if (material.alphaMode == AlphaMode::mask) return;  // has holes
  for (const Chart& chart : patches.charts) {
    if (chart.outline.empty()) continue;
    for (const uint32_t t : chart.triangles)
      object.polygonOf[t] = static_cast<int>(object.polygons.size());
    object.polygons.push_back({chart.outline, chart.normal});
  }
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

Occlusion Occluders::occlusionOf(const RenderScene& s, const OcclusionPyramid& pyramid) const {
  if (pyramid.isDark()) return Occlusion::full;
  if (pyramid.isDegenerate()) return Occlusion::partial;
  bool met = false, hidden = false;
  const auto enter = [&](const Bounds& b) { return pyramid.mayMeet(b); };
  tree_.visit(enter, [&](uint32_t index) {
    const RenderObject& o = s.objects[index];
    const Object& object = objects_[index];
    // Once it is met, only what may hide the patch wholly is of interest.
    const auto enterObject = [&](const Bounds& b) {
      return !(met && object.polygons.empty()) && pyramid.mayMeet(b);
    };
    int last = kNone;
    return object.triangles.visit(enterObject, [&](uint32_t t) {
      const int polygon = object.polygonOf[t];
      if (met && (polygon == kNone || polygon == last)) return true;
      const uint32_t* corner = &s.indices[o.firstIndex + 3 * t];
      if (!pyramid.meets(s.positions[corner[0]], s.positions[corner[1]], s.positions[corner[2]]))
        return true;
      met = true;
      if (polygon == kNone) return true;
      last = polygon;
      const Polygon& p = object.polygons[static_cast<size_t>(polygon)];
      hidden = pyramid.isCutBy(p.corners, p.normal);
      return !hidden;
    });
  });
  return hidden ? Occlusion::full : met ? Occlusion::partial : Occlusion::none;
}

}  // namespace lamplighter
