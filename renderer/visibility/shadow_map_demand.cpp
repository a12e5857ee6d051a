#include "renderer/visibility/shadow_map_demand.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "renderer/visibility/potentially_visible_patches.h"

namespace lamplighter {
namespace {

class Walk {
 public:
  Walk(const VisibilityDatabase& visibility, const RenderScene& scene,
       const PotentiallyVisiblePatches& seen, const shared::Vpl& eye, uint32_t object,
       std::vector<uint8_t>& found)
      : visibility_(visibility),
        scene_(scene),
        patches_(visibility.patches(object)),
        seen_(seen),
        eye_(eye),
        object_(object),
        backIsUnseen_(scene.backIsUnseen(object)),
        found_(found) {}

  void visit(int index) {
    const Patch& patch = patches_.patches[static_cast<size_t>(index)];
    if (!seen_.mayShow(patch) || isTurnedAway(patch)) return;
    if (!patch.isLeaf() && visibility_.isDivided(object_, index)) {
      visit(patch.firstChild);
      visit(patch.firstChild + 1);
      return;
    }
    // Most lights are found on the first patches, so the other patches need no test of whether they
    // are hidden.
    const auto states = visibility_.row(object_, index);
    uint8_t isNew = 0;
    for (size_t slot = 0; slot < states.size(); ++slot)
      isNew |= isPartial(states[slot]) & ~found_[slot];
    if (isNew == 0 || visibility_.isHiddenFromEye(scene_, eye_, object_, index)) return;
    for (size_t slot = 0; slot < states.size(); ++slot) found_[slot] |= isPartial(states[slot]);
  }

 private:
  static uint8_t isPartial(uint8_t state) {
    return state == static_cast<uint8_t>(Occlusion::partial) ? 1 : 0;
  }
  bool isTurnedAway(const Patch& patch) const {
    if (!backIsUnseen_ || patch.chart == kNone) return false;
    const Chart& chart = patches_.charts[static_cast<size_t>(patch.chart)];
    // The bumps of a rough chart face other directions than the chart.
    if (chart.isRough) return false;
    return glm::dot(vec3(eye_.position) - patch.centre, chart.normal) < -chart.thickness - 0.001f;
  }

  const VisibilityDatabase& visibility_;
  const RenderScene& scene_;
  const ObjectPatches& patches_;
  const PotentiallyVisiblePatches& seen_;
  const shared::Vpl& eye_;
  const uint32_t object_;
  const bool backIsUnseen_;
  std::vector<uint8_t>& found_;
};

}  // namespace

std::vector<uint8_t> shadowMapDemand(const VisibilityDatabase& visibility, const RenderScene& scene,
                                     const View& view) {
  const PotentiallyVisiblePatches seen(view);
  const size_t slots = visibility.slots();
  const shared::Vpl eye{vec4(view.eye, shared::kVplUniform), vec4(view.forward(), 0.0f),
                        vec4(view.right(), 1.0f), vec3(0.0f), 0};
  tbb::enumerable_thread_specific<std::vector<uint8_t>> found(
      [&] { return std::vector<uint8_t>(slots, 0); });
  // The jobs are roots and not objects, because a level may be a single object.
  struct Root {
    uint32_t object;
    int patch;
  };
  std::vector<Root> roots;
  for (uint32_t i = 0; i < visibility.objects(); ++i)
    if (seen.mayShow(visibility.patches(i).bounds))
      for (const int root : visibility.patches(i).roots) roots.push_back({i, root});
  tbb::parallel_for(size_t{0}, roots.size(), [&](size_t i) {
    Walk(visibility, scene, seen, eye, roots[i].object, found.local()).visit(roots[i].patch);
  });
  std::vector<uint8_t> all(slots, 0);
  for (const std::vector<uint8_t>& some : found)
    for (size_t slot = 0; slot < slots; ++slot) all[slot] |= some[slot];
  return all;
}

}  // namespace lamplighter
