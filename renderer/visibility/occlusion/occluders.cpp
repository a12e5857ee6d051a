#include "renderer/visibility/occlusion/occluders.h"

#include <algorithm>

#include "renderer/patches/triangle_bounds.h"

namespace lamplighter {
namespace {

// Smallest area of polygons that are tested as full occluders, such as walls [m²].
constexpr float kLargePolygon = 1.0f;

}  // namespace

void Occluders::place(const RenderScene& s, uint32_t index, const MeshTopology& topology,
                      const ObjectPatches& patches) {
  const RenderObject& o = s.objects[index];
  Object& object = objects_[index];
  object = Object();
  object.caster = Caster(patches.bounds, patches.radius);
  if (o.isEmpty()) return;
  const Material& material = s.materials[static_cast<size_t>(o.material)];
  if (material.isClear()) return;
  object.flat = topology.flat;
  if (std::any_of(patches.charts.begin(), patches.charts.end(),
                  [](const Chart& c) { return c.isRough; })) {
    for (size_t c = 0; c < patches.charts.size(); ++c)
      object.roughChart.insert(object.roughChart.end(), patches.charts[c].triangles.size(),
                               patches.charts[c].isRough ? static_cast<int>(c) : kNone);
  }
  std::vector<Bounds> boxes;
  for (const uint32_t t : object.flat) boxes.push_back(boundsOf(s, o, {&t, 1}));
  object.groups = patches.groups;
  boxes.insert(boxes.end(), object.groups.begin(), object.groups.end());
  object.tree = topology.occluders;
  object.tree.refit(boxes);
  if (material.alphaMode == AlphaMode::mask) return;  // has holes
  boxes.clear();
  for (const Chart& chart : patches.charts) {
    if (chart.outline.empty() || chart.area < kLargePolygon) continue;
    boxes.push_back(object.polygons.emplace_back(chart.outline, chart.normal).box);
  }
  object.polygonTree = BoundsTree(boxes);
}

void Occluders::finish(const RenderScene& s) {
  std::vector<Bounds> boxes(s.objects.size()), polygons(s.objects.size());
  for (size_t i = 0; i < boxes.size(); ++i) {
    boxes[i] = s.objects[i].bounds;
    polygons[i] = objects_[i].polygonTree.bounds();
  }
  const auto fit = [](BoundsTree& tree, std::span<const Bounds> to) {
    if (tree.size() == to.size()) {
      tree.refit(to);
    } else {
      tree = BoundsTree(to);
    }
  };
  fit(tree_, boxes);
  fit(polygonTree_, polygons);
}

bool Occluders::meets(const RenderScene& s, const OcclusionPyramid& pyramid, uint32_t index,
                      uint32_t item, vec3& at) const {
  const Object& object = objects_[index];
  if (item >= object.flat.size()) {
    const Bounds& group = object.groups[item - object.flat.size()];
    at = group.centre();
    return pyramid.mayMeet(group);
  }
  const uint32_t* i = &s.indices[s.objects[index].firstIndex + 3 * object.flat[item]];
  return pyramid.meets(s.positions[i[0]], s.positions[i[1]], s.positions[i[2]], &at);
}

bool Occluders::isItself(const OcclusionPyramid& pyramid, uint32_t index, uint32_t item) const {
  const Object& object = objects_[index];
  return item < object.flat.size() && !object.roughChart.empty() &&
         object.roughChart[item] != kNone && pyramid.isOfRough(index, object.roughChart[item]);
}

bool Occluders::meets(const RenderScene& s, const OcclusionPyramid& pyramid, uint32_t index,
                      Blocker& met) const {
  const Caster& caster = objects_[index].caster;
  if (!pyramid.mayMeetSphere(caster.box.centre(), 1.001f * caster.radius)) return false;
  const bool isMet = !objects_[index].tree.visit(
      [&](const Bounds& b) { return pyramid.mayMeet(b); },
      [&](uint32_t item) {
        vec3 at;
        if (isItself(pyramid, index, item) || !meets(s, pyramid, index, item, at)) return true;
        met = {static_cast<int>(index), item, true, at};
        return false;
      });
  return isMet && pyramid.mayBeShadowedBy(caster);
}

bool Occluders::stillMeets(const RenderScene& s, const OcclusionPyramid& pyramid,
                           Blocker& blocker) const {
  if (blocker.object == kNone) return false;
  const auto object = static_cast<uint32_t>(blocker.object);
  const Caster& caster = objects_[object].caster;
  if (!pyramid.mayMeetSphere(caster.box.centre(), 1.001f * caster.radius)) return false;
  if (isItself(pyramid, object, blocker.item)) return false;
  if (!blocker.hasPoint || !pyramid.holds(blocker.at)) {
    if (!meets(s, pyramid, object, blocker.item, blocker.at)) {
      blocker.hasPoint = false;
      return false;
    }
    blocker.hasPoint = true;
  }
  return pyramid.mayBeShadowedBy(caster);
}

Occlusion Occluders::occlusionWithout(const RenderScene& s, const OcclusionPyramid& pyramid,
                                      std::span<const uint32_t> objects, Blocker& first) const {
  if (pyramid.isDark()) return Occlusion::full;
  if (pyramid.isDegenerate()) return Occlusion::partial;
  const auto counts = [&](uint32_t i) {
    return std::find(objects.begin(), objects.end(), i) == objects.end();
  };
  const auto enter = [&](const Bounds& b) { return pyramid.mayMeet(b); };
  // A cluster of a complex mesh occludes itself.
  const bool isMet =
      pyramid.isOfBox() || stillMeets(s, pyramid, first) ||
      !tree_.visit(enter, [&](uint32_t i) { return !(counts(i) && meets(s, pyramid, i, first)); });
  if (!isMet) return Occlusion::none;
  return hiddenWithout(pyramid, objects) ? Occlusion::full : Occlusion::partial;
}

Occlusion Occluders::occlusionBy(const RenderScene& s, const OcclusionPyramid& pyramid,
                                 std::span<const uint32_t> objects, Blocker& first) const {
  if (pyramid.isDark()) return Occlusion::full;
  if (pyramid.isDegenerate()) return Occlusion::partial;
  bool isMet = stillMeets(s, pyramid, first);
  for (const uint32_t i : objects) {
    if (!isMet) isMet = meets(s, pyramid, i, first);
    if (mayHide(i) && isHiddenBy(pyramid, i)) return Occlusion::full;
  }
  return isMet ? Occlusion::partial : Occlusion::none;
}

}  // namespace lamplighter
