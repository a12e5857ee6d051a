// The scene as the renderer sees it: visible triangles in world space, one buffer for all (paper 1,
// 4.2.2: occluders are transformed once on the CPU, so that a shadow map is few draws), and the
// emitters among them.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/scene/scene_changes.h"

namespace lamplighter {

// One primitive of one node, or the surface of one area light.
struct RenderObject {
  NodeId node = kNoNode;
  int material = 0;  // index into RenderScene::materials
  uint32_t firstVertex = 0, vertexCount = 0;
  uint32_t firstIndex = 0, indexCount = 0;  // indices are absolute: into RenderScene::positions
  Bounds bounds;                            // world space
  mat4 world{1.0f};                         // its node's, as of its vertices now
  MeshKind kind = MeshKind::automatic;      // its node's
  bool isAreaLight = false;                 // tessellated from Node::area
  uint32_t link = 0;                        // of its own light, if it emits (light_linking.h)
  uint32_t leftOutBy = 0;                   // a bit for each link that gives it no light
  uint32_t triangleCount() const { return indexCount / 3; }
};

// A punctual light in world space.
struct RenderPunctual {
  NodeId node = kNoNode;
  PunctualLight light;  // its intensity with the factor of its profile at its tilt
  vec3 position{0.0f};
  vec3 direction{0.0f, 0.0f, -1.0f};  // unit, where it aims
  mat3 axes{1.0f};                    // its X, Y and Z, orthonormal; Z is −direction
  uint32_t link = 0;                  // light_linking.h
};

struct RenderScene {
  // Per vertex, world space. tangents, uv and colors always have positions.size() entries (zero
  // tangent, zero uv, white colour where the file has none).
  std::vector<vec3> positions, normals;
  std::vector<vec3> localPositions, localNormals;  // the same vertices in their node's space
  std::vector<vec4> tangents;
  std::vector<vec2> uv0, uv1;
  std::vector<vec4> colors;
  std::vector<uint32_t> indices;
  std::vector<RenderObject> objects;
  // Scene::materials, then the default material, then one for each area light (albedo 0), then
  // copies that emit nothing, for emissive meshes that do not shine.
  std::vector<Material> materials;
  std::vector<int> darkMaterials;  // of which of Scene::materials those copies are
  std::vector<Texture> textures;   // Scene::textures, then those of area lights' pictures
  std::vector<RenderPunctual> punctuals;
  Sky sky;
  uint32_t skyLink = 0;   // light_linking.h
  bool hasLinks = false;  // some light leaves something out
  Bounds bounds;          // of all objects

  size_t triangleCount() const { return indices.size() / 3; }

  // Whether cameras see the object's front faces alone, so that one looks into a closed room from
  // outside: back faces of materials that are not double-sided are culled (glTF 2.0, section 3.9).
  // Light is stopped and reflected by both sides. An area light is seen from behind, dark.
  bool backIsUnseen(uint32_t object) const {
    const RenderObject& o = objects[object];
    return !o.isAreaLight && !materials[static_cast<size_t>(o.material)].doubleSided;
  }
};

// What update() did, for those who keep copies (Embree, GL buffers).
struct RenderSceneChanges {
  bool rebuilt = false;                // every array is new
  std::vector<uint32_t> movedObjects;  // vertex attributes of these changed in place
  std::vector<Bounds> movedBounds;     // where each moved object was before, in that order
  bool materials = false;              // parameters of materials changed (not the count)
  bool lights = false;                 // punctual lights changed or moved
  bool sky = false;

  bool none() const { return !rebuilt && movedObjects.empty() && !materials && !lights && !sky; }
  // Takes in what a later update() did.
  void merge(const RenderSceneChanges& later);
};

// Brings `render` up to date with `scene`. Throws nothing; a scene without nodes gives no objects.
RenderSceneChanges update(RenderScene& render, const Scene& scene, const SceneChanges& changes);

}  // namespace lamplighter
