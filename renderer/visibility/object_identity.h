// Finds unchanged objects across a rebuild of the scene, which renumbers all objects but does not
// change most of them.
#pragma once

#include <vector>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

// All properties of an object from which patches and occluders are made.
struct ObjectIdentity {
  NodeId node = kNoNode;
  uint64_t geometry = 0;  // hash of its world-space vertices and its indices
  MeshKind kind = MeshKind::automatic;
  uint32_t leftOutBy = 0;  // light_linking.h
  bool isClear = false, isMasked = false, backIsUnseen = false, hasNormalTexture = false;
  bool operator==(const ObjectIdentity&) const = default;
};
ObjectIdentity identify(const RenderScene& scene, uint32_t object);
std::vector<ObjectIdentity> identify(const RenderScene& scene);

// For each present object the index of the identical object in `before`; kNone if there was none.
std::vector<int> findSame(const std::vector<ObjectIdentity>& before,
                          const std::vector<ObjectIdentity>& now);

}  // namespace lamplighter
