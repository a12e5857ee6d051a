// Lists of the VPLs that the pixels of each patch sum, in the layout of the shader: one buffer.
#pragma once

#include <span>
#include <vector>

#include "renderer/light_maps/patch_lights.h"
#include "renderer/scene/frustum.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter::gl {

// VPLs that one draw can sum; consecutive in the order of the sum.
struct LightGroup {
  size_t first = 0, count = 0;
};

// An object whose patches may be visible.
struct SeenObject {
  uint32_t object = 0;     // index into RenderScene::objects
  uint32_t firstNode = 0;  // index of its first patch among the patches of the scene
  bool backIsCulled = false;
};

class LightLists {
 public:
  // Makes lists for the leaves in the frustum; all others get empty lists. nodes: number of patches
  // in the scene. At most 65,535 VPLs per group. Resets the passes.
  void make(const PatchLights& patches, std::span<const SeenObject> objects, size_t nodes,
            const Frustum& frustum, std::span<const shared::Vpl> vpls,
            std::span<const LightGroup> groups);
  // Distributes the entries that need shadow maps to passes of at most `lightsPerPass` lights,
  // merged over the objects (pass_merging.h), and sorts the entries by pass. Call once after
  // make(). Throws InputError if there are more passes than an entry can store.
  void mergePasses(int lightsPerPass);

  // Number of places (shaders/shared/patches.h), including the empty place.
  static size_t places(size_t nodes) { return 1 + 2 * nodes; }
  // By group, then place. x: index of the first entry. y: the number of entries without a map
  // look-up (low 16 bits), and of those with one (high 16 bits), which follow.
  std::span<const glm::uvec2> ranges() const { return ranges_; }
  // Index in the group, with kTakeShadow and, after merging, the pass times kPassUnit.
  std::span<const uint32_t> entries() const { return entries_; }
  // By group: the length of the longest list, and of the longest part without map look-ups.
  std::span<const int> longest() const { return longest_; }
  std::span<const int> longestPlain() const { return longestPlain_; }
  // By place, 1 if a light that makes hard shadows is partly hidden from it (hard_shadow_lights.h).
  // Empty: no place is.
  std::span<const uint32_t> hardPlaces() const { return hardPlaces_; }
  // By group: the number of passes; and the number of passes that merging saved in total.
  std::span<const int> passes() const { return passes_; }
  int passesSaved() const { return passesSaved_; }

 private:
  // The places of an object that have lists.
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
  size_t stride_ = 0;  // number of places per group
  std::vector<int> passes_;
  int passesSaved_ = 0;
};

}  // namespace lamplighter::gl
