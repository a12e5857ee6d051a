// Small scenes for tests.
#pragma once

#include <string>

#include "renderer/scene/render_scene.h"
#include "renderer/scene/scene.h"

namespace lamplighter::test {

// A square of side `size` in the XZ plane of its node, facing +Y.
std::shared_ptr<const Mesh> squareMesh(float size, int material = kNone);
// An axis-aligned box with outward faces, centred on its node.
std::shared_ptr<const Mesh> boxMesh(const vec3& size, int material = kNone);
// A box seen from inside.
std::shared_ptr<const Mesh> roomMesh(const vec3& size, int material = kNone);
// A sphere with smooth normals. It has `rings` segments from pole to pole and twice as many around;
// vertices at the seam are duplicated. `bump` varies the radius in waves by that fraction.
std::shared_ptr<const Mesh> sphereMesh(float radius, uint32_t rings, float bump = 0.0f,
                                       int material = kNone);

// Adds a node; returns its id.
NodeId addNode(Scene& scene, const std::string& name, NodeId parent = kNoNode,
               const vec3& at = vec3(0.0f));
NodeId addMesh(Scene& scene, std::shared_ptr<const Mesh> mesh, const vec3& at = vec3(0.0f));
// A rectangle light at `at` that emits downwards.
NodeId addRectangleLight(Scene& scene, const vec3& at, const vec2& size, const vec3& radiance);
int addMaterial(Scene& scene, const vec3& albedo, const vec3& emissive = vec3(0.0f));
int addMaterial(Scene& scene, const vec3& colour, float metallic, float roughness);

// The renderer's scene, newly built.
RenderScene renderSceneOf(const Scene& scene);
// The changes of a newly built scene.
RenderSceneChanges everythingRebuilt();

}  // namespace lamplighter::test
