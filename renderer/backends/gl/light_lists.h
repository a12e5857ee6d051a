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
  // 65,535 VPLs a group.
  void make(const PatchLights& patches, std::span<const SeenObject> objects, size_t nodes,
            const Frustum& frustum, std::span<const shared::Vpl> vpls,
            std::span<const LightGroup> groups);

  // Places (shaders/shared/patches.h), with that of nothing.
  static size_t places(size_t nodes) { return 1 + 2 * nodes; }
  // By group, then place: x: first of `entries`, y: how many need no map, and above bit 16 those
  // that come after and do.
  std::span<const glm::uvec2> ranges() const { return ranges_; }
  // Numbers within the group, with kTakeShadow.
  std::span<const uint32_t> entries() const { return entries_; }
  // The longest list of each group.
  std::span<const int> longest() const { return longest_; }

 private:
  std::vector<glm::uvec2> ranges_;
  std::vector<uint32_t> entries_;
  std::vector<int> longest_;
};

}  // namespace lamplighter::gl
