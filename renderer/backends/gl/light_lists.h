// Which VPLs the pixels of each patch sum, as the sum's shader takes them: lists in one buffer.
#pragma once

#include <span>
#include <vector>

#include "renderer/backends/gl/frustum.h"
#include "renderer/light_maps/patch_lights.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter::gl {

// VPLs that one draw can sum, one after the other in the order of the sum.
struct LightGroup {
  size_t first = 0, count = 0;
};

// An object whose patches may be seen.
struct SeenObject {
  uint32_t object = 0;     // index into RenderScene::objects
  uint32_t firstNode = 0;  // of its patches among those of the scene
  bool backIsCulled = false;
};

class LightLists {
 public:
  // For leaves in the frustum; all others get empty lists. nodes: patches of the scene. At most
  // 65,535 VPLs a group. No passes.
  void make(const PatchLights& patches, std::span<const SeenObject> objects, size_t nodes,
            const Frustum& frustum, std::span<const shared::Vpl> vpls,
            std::span<const LightGroup> groups);
  // Puts the entries that need their maps into passes of at most `lightsPerPass` lights, merged
  // over the objects (pass_merging.h), and in their order. Once after make(). Throws InputError
  // when they are more than entries can name.
  void mergePasses(int lightsPerPass);

  // Places (shaders/shared/patches.h), with that of nothing.
  static size_t places(size_t nodes) { return 1 + 2 * nodes; }
  // By group, then place: x: first of `entries`, y: how many need no map, and above bit 16 those
  // that come after and do.
  std::span<const glm::uvec2> ranges() const { return ranges_; }
  // Numbers within the group, with kTakeShadow and, once merged, times of kPassUnit.
  std::span<const uint32_t> entries() const { return entries_; }
  // The longest list of each group, and the longest of what of it needs no map.
  std::span<const int> longest() const { return longest_; }
  std::span<const int> longestPlain() const { return longestPlain_; }
  // By place, 1: one of the lights that make hard shadows is partly hidden from it
  // (hard_shadow_lights.h). Empty: no place is.
  std::span<const uint32_t> hardPlaces() const { return hardPlaces_; }
  // By group, and what merging spared of all.
  std::span<const int> passes() const { return passes_; }
  int passesSaved() const { return passesSaved_; }

 private:
  // Those of an object that have lists.
  struct ObjectPlaces {
    uint32_t object = 0;
    std::vector<size_t> places;
  };
  std::span<uint32_t> shadowedOf(size_t group, size_t place);
  void mergeGroup(size_t group, int lightsPerPass);

  std::vector<glm::uvec2> ranges_;
  std::vector<uint32_t> entries_, hardPlaces_;
  std::vector<int> longest_, longestPlain_;
  std::vector<LightGroup> groups_;
  std::vector<ObjectPlaces> objects_;
  size_t stride_ = 0;  // places of a group
  std::vector<int> passes_;
  int passesSaved_ = 0;
};

}  // namespace lamplighter::gl
