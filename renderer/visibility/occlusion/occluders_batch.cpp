// Finds occluders between a patch and several lights together: the trees are traversed for the
// pyramids of eight lights, and most triangles are decided for all eight at once. A triangle is
// clipped for a single light only if it is not outside one plane of the pyramid and has no corner
// inside. That is done last, because most such lights meet another occluder before.
#include <algorithm>
#include <array>
#include <bit>

#include "renderer/raycast/ray_caster.h"
#include "renderer/visibility/occlusion/bit_iteration.h"
#include "renderer/visibility/occlusion/occluders.h"
#include "renderer/visibility/occlusion/pyramid_batch.h"

namespace lamplighter {

using Mask = LightMask;

namespace {

// For fewer lights the triangle is clipped directly.
constexpr int kWorthSieve = 2;

}  // namespace

// Finds which of some lights meet an occluder.
class Occluders::Search {
 public:
  Search(const Occluders& occluders, const RenderScene& scene, const Lights& lights,
         const LightPacket& lanes, std::span<const Blocker> first)
      : occluders_(occluders),
        scene_(scene),
        lights_(lights),
        pyramids_(lanes, lights.region),
        count_(lights.vpls.size()),
        open_(pyramids_.all()) {
    std::copy(first.begin(), first.end(), first_.begin());
  }

  // Searches all objects except some.
  Mask run(std::span<const uint32_t> without) {
    askWhereMetBefore();
    if (open_ != 0) searchTrees(without);
    clip();
    return pyramids_.all() & ~open_;
  }

  // By light: the blocker that was met, or the one that was tested first.
  std::span<const Blocker> first() const { return first_; }

 private:
  struct Question {
    uint32_t object, item;
    Mask lights;
  };

  // The undecided lights whose pyramid may meet a part of the object.
  Mask mayMeet(uint32_t object) const {
    const Caster& caster = occluders_.objects_[object].caster;
    return open_ & pyramids_.mayMeetSphere(caster.box.centre(), 1.001f * caster.radius);
  }

  // Tests the points where a light met something at the parent patch, then the items themselves,
  // for all lights.
  void askWhereMetBefore() {
    const std::array<Blocker, LightPacket::kLights> first = first_;
    const auto isNew = [&](size_t i, const auto& isSame) {
      return first[i].object != kNone &&
             std::none_of(first.begin(), first.begin() + static_cast<ptrdiff_t>(i), isSame);
    };
    for (size_t i = 0; i < count_ && open_ != 0; ++i) {
      const Blocker& b = first[i];
      if (!b.hasPoint || !isNew(i, [&](const Blocker& o) { return o.hasPoint && o.at == b.at; }))
        continue;
      const auto object = static_cast<uint32_t>(b.object);
      const Mask held = open_ & pyramids_.hold(b.at);
      if (held == 0 || isOfPatch(object, b.item)) continue;
      if (Mask some = held & mayMeet(object); some != 0) take(b, some, some);
    }
    for (size_t i = 0; i < count_ && open_ != 0; ++i) {
      const Blocker& b = first[i];
      if ((open_ >> i & 1) == 0 ||
          !isNew(i, [&](const Blocker& o) { return o.object == b.object && o.item == b.item; }))
        continue;
      const auto object = static_cast<uint32_t>(b.object);
      if (Mask some = mayMeet(object); some != 0) ask(object, b.item, some);
    }
  }

  void searchTrees(std::span<const uint32_t> without) {
    const auto enter = [&](const Bounds& b) { return (open_ & pyramids_.mayMeet(b)) != 0; };
    occluders_.tree_.visit(enter, [&](uint32_t object) {
      if (std::find(without.begin(), without.end(), object) != without.end()) return true;
      Mask some = mayMeet(object);
      if (some == 0) return true;
      occluders_.objects_[object].tree.visit(
          [&](const Bounds& b) { return (some & pyramids_.mayMeet(b)) != 0; },
          [&](uint32_t item) {
            ask(object, item, some);
            return some != 0;
          });
      return open_ != 0;
    });
  }

  // Removes the lights from `some` that are decided for the whole object.
  void ask(uint32_t object, uint32_t item, Mask& some) {
    const Object& o = occluders_.objects_[object];
    const auto index = static_cast<int>(object);
    if (item >= o.flat.size()) {
      const Bounds& group = o.groups[item - o.flat.size()];
      take({index, item, true, group.centre()}, some & pyramids_.mayMeet(group), some);
      return;
    }
    if (isOfPatch(object, item)) return;
    const std::array<vec3, 3> corners = cornersOf(object, item);
    const PyramidBatch::Met answer = pyramids_.meets(corners);
    if (const Mask unsure = some & answer.unsure; unsure != 0) {
      if (unsureCount_ == unsure_.size()) clip();
      unsure_[unsureCount_++] = {object, item, unsure};
    }
    for (size_t i = 0; i < 3; ++i)
      if (const Mask met = some & answer.byCorner[i]; met != 0)
        take({index, item, true, corners[i]}, met, some);
  }

  // Registers lights that meet an item, except those for which the object casts no shadow on the
  // patch.
  void take(const Blocker& blocker, Mask met, Mask& some) {
    some &= ~met;
    forEachBit(met, [&](size_t i) {
      if (!mayBeShadowed(i, static_cast<uint32_t>(blocker.object))) return;
      open_ &= ~(Mask{1} << i);
      first_[i] = blocker;
    });
  }

  void clip() {
    for (size_t q = 0; q < unsureCount_; ++q) {
      const Question& question = unsure_[q];
      Mask some = question.lights & open_;
      if (some == 0) continue;
      const std::array<vec3, 3> t = cornersOf(question.object, question.item);
      if (std::popcount(some) >= kWorthSieve) some &= ~pyramids_.surelyMiss(t, roundingOf(t));
      while ((some &= open_) != 0) {
        const auto i = static_cast<size_t>(std::countr_zero(some));
        const Mask one = Mask{1} << i;
        if ((known_ & one) == 0) planes_[i] = pyramids_.planesOf(i);
        known_ |= one;
        vec3 at;
        Mask met = 0;
        // If one light meets it, others probably do.
        if (planes_[i].meet(t[0], t[1], t[2], &at)) met = one | (some & pyramids_.hold(at));
        some &= ~one;
        take({static_cast<int>(question.object), question.item, true, at}, met, some);
      }
    }
    unsureCount_ = 0;
  }

  // The bumps of a rough chart do not block its own light.
  bool isOfPatch(uint32_t object, uint32_t item) const {
    const PatchRegion& region = lights_.region;
    const std::vector<int>& chart = occluders_.objects_[object].roughChart;
    return region.object == static_cast<int>(object) && item < chart.size() &&
           chart[item] != kNone && chart[item] == region.chart;
  }
  std::array<vec3, 3> cornersOf(uint32_t object, uint32_t item) const {
    const uint32_t* i = &scene_.indices[scene_.objects[object].firstIndex +
                                        3 * occluders_.objects_[object].flat[item]];
    return {scene_.positions[i[0]], scene_.positions[i[1]], scene_.positions[i[2]]};
  }
  static float roundingOf(const std::array<vec3, 3>& corners) {
    return rayEpsilon(
        glm::max(glm::max(glm::abs(corners[0]), glm::abs(corners[1])), glm::abs(corners[2])));
  }
  bool mayBeShadowed(size_t light, uint32_t object) const {
    return ShadowVolume(*lights_.vpls[light], occluders_.objects_[object].caster)
        .mayFallOn(lights_.region.centre, lights_.region.radius);
  }

  const Occluders& occluders_;
  const RenderScene& scene_;
  const Lights& lights_;
  const PyramidBatch pyramids_;
  const size_t count_;
  std::array<Blocker, LightPacket::kLights> first_;  // by light: tested first, or met
  Mask open_;                                        // lights for which nothing was met yet
  Mask known_ = 0;                                   // lights whose planes_ are set
  std::array<PyramidPlanes, LightPacket::kLights> planes_;
  std::array<Question, 64> unsure_;
  size_t unsureCount_ = 0;
};

Occluders::States Occluders::occlusionsWithout(const RenderScene& s, const Lights& lights,
                                               std::span<const uint32_t> objects,
                                               std::span<Blocker> first) const {
  std::array<PyramidApex, LightPacket::kLights> apices;
  std::array<const PyramidApex*, LightPacket::kLights> pointers;
  for (size_t i = 0; i < lights.vpls.size(); ++i) {
    apices[i] = PyramidApex(*lights.vpls[i]);
    pointers[i] = &apices[i];
  }
  const LightPacket lanes({pointers.data(), lights.vpls.size()});
  States states;
  states.fill(Occlusion::none);
  // A cluster of a complex mesh occludes itself.
  Mask met = lanes.all();
  if (!lights.region.isBox()) {
    Search search(*this, s, lights, lanes, first);
    met = search.run(objects);
    std::copy_n(search.first().begin(), first.size(), first.begin());
  }
  if (met == 0) return states;
  const Mask hidden = hiddenWithout(lanes, lights.region, met, objects);
  forEachBit(met, [&](size_t i) {
    states[i] = (hidden >> i & 1) != 0 ? Occlusion::full : Occlusion::partial;
  });
  return states;
}

}  // namespace lamplighter
