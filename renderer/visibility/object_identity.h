// Which objects are the same as before, across a rebuild of the scene: adding, removing or hiding
// one renumbers all, but changes nothing about the others.
#pragma once

#include <vector>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

// All of an object that patches and occluders are made of.
struct ObjectIdentity {
  NodeId node = kNoNode;
  uint64_t geometry = 0;  // hash of its vertices in the world and of its indices
  MeshKind kind = MeshKind::automatic;
  uint32_t leftOutBy = 0;  // light_linking.h
  bool isClear = false, isMasked = false, backIsUnseen = false, hasNormalTexture = false;
  bool operator==(const ObjectIdentity&) const = default;
};
ObjectIdentity identify(const RenderScene& scene, uint32_t object);
std::vector<ObjectIdentity> identify(const RenderScene& scene);

// For each object now the index of the same one before; kNone: there was none.
std::vector<int> findSame(const std::vector<ObjectIdentity>& before,
                          const std::vector<ObjectIdentity>& now);

}  // namespace lamplighter
