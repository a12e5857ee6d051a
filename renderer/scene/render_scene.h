// The scene as the renderer uses it: visible triangles in world space in one buffer, and the
// emitters. Lengths are in RenderScene::unit, so that constants of the renderer that are given in
// metres suit levels of any size. Occluders are transformed once on the CPU, so that a shadow map
// needs few draw calls (paper 1, 4.2.2).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "renderer/scene/scene.h"
#include "renderer/scene/scene_changes.h"

namespace lamplighter {

// One primitive of one node, or the surface of one area light. Empty while it is hidden, and after
// its node was deleted: without triangles, bounds or node.
struct RenderObject {
  NodeId node = kNoNode;
  int material = 0;  // index into RenderScene::materials
  uint32_t firstVertex = 0, vertexCount = 0;
  uint32_t firstIndex = 0, indexCount = 0;  // indices into RenderScene::positions
  Bounds bounds;                            // world space
  mat4 world{1.0f};                         // from the node to world space at the last update
  MeshKind kind = MeshKind::automatic;      // of the node
  bool isAreaLight = false;                 // tessellated from Node::area
  uint32_t link = 0;                        // of its own light if it emits (light_linking.h)
  uint32_t leftOutBy = 0;                   // one bit per link that gives it no light
  uint32_t triangleCount() const { return indexCount / 3; }
  bool isEmpty() const { return indexCount == 0; }
};

// The surface for which an entry of RenderScene::objects is reserved, also while it is empty. An
// entry never gets another surface, so data about its mesh stays valid.
struct ObjectSlot {
  NodeId node = kNoNode;
  std::shared_ptr<const Mesh> mesh;  // null: the surface of an area light
  uint32_t primitive = 0;            // of the mesh
  AreaShape shape = AreaShape::rectangle;
  vec2 size{0.0f};  // size of the area light when it was last placed
  // Its part of the vertices and indices of the scene. No vertices: it was never shown.
  uint32_t firstVertex = 0, vertexCount = 0;
  uint32_t firstIndex = 0, indexCount = 0;
};

// A punctual light in world space.
struct RenderPunctual {
  NodeId node = kNoNode;
  // In the unit of the scene: an intensity is the irradiance at a distance of one unit. It includes
  // the tilt factor of the profile, and is 0 while the light is off.
  PunctualLight light;
  vec3 nominal{0.0f};  // its intensity while it is on
  vec3 position{0.0f};
  vec3 direction{0.0f, 0.0f, -1.0f};  // unit; the direction in which it aims
  mat3 axes{1.0f};                    // its X, Y and Z axes, orthonormal; Z is −direction
  uint32_t link = 0;                  // light_linking.h

  bool operator==(const RenderPunctual&) const = default;
};

// Objects keep their index until the scene is rebuilt: hidden and deleted ones become empty, new
// ones are appended, and one that comes back takes its old place if it has the same surface.
// Objects that are not empty are always in the order of nodes and primitives.
struct RenderScene {
  // Per vertex, world space. tangents, uv and colors always have positions.size() entries; missing
  // ones are a zero tangent, zero uv and white.
  std::vector<vec3> positions, normals;
  std::vector<vec3> localPositions, localNormals;  // the same vertices in the space of their node
  std::vector<vec4> tangents;
  std::vector<vec2> uv0, uv1;
  std::vector<vec4> colors;
  std::vector<uint32_t> indices;
  std::vector<RenderObject> objects;
  std::vector<ObjectSlot> slots;  // by object
  // Scene::materials, then the default material, then one for each area light (albedo 0), then a
  // copy of each of Scene::materials without emission, for meshes that are switched off.
  std::vector<Material> materials;
  int firstDark = 0;  // index of the first of these copies
  // By material: the emission while its light is on [W/(m² sr)].
  std::vector<vec3> nominalEmission;
  std::vector<Texture> textures;  // Scene::textures, then those of pictures on area lights
  std::vector<RenderPunctual> punctuals;
  Sky sky;                // black while it is off
  Sky nominalSky;         // while it is on
  uint32_t skyLink = 0;   // light_linking.h
  bool hasLinks = false;  // some light leaves objects out
  float unit = 1.0f;      // of all lengths here: a power of two, in metres of Scene
  Bounds bounds;          // of all objects

  // Number of triangles of all objects. O(objects).
  size_t triangleCount() const {
    size_t count = 0;
    for (const RenderObject& o : objects) count += o.triangleCount();
    return count;
  }

  // Whether cameras see only the front faces of the object: back faces of single-sided materials
  // are culled (glTF 2.0, section 3.9), so that the user can look into a closed room from outside.
  // Both sides block and reflect light. An area light is visible from behind, as a dark surface.
  bool backIsUnseen(uint32_t object) const {
    const RenderObject& o = objects[object];
    return !o.isAreaLight && !materials[static_cast<size_t>(o.material)].doubleSided;
  }
};

// What update() changed, for code that keeps copies of the scene (Embree, GL buffers).
struct RenderSceneChanges {
  bool rebuilt = false;  // every array is new
  // Objects whose vertices changed, or that were added or removed. New ones may be behind the last
  // object.
  std::vector<uint32_t> movedObjects;
  // Bounds of each moved object before, in the order of movedObjects; empty: it was added.
  std::vector<Bounds> movedBounds;
  bool objects = false;    // some objects were added or removed; materials may have other indices
  bool materials = false;  // parameters of materials changed (not the number of
                           // materials), beyond the radiance that they emit
  std::vector<int> emissions;  // sorted; materials of which only the emitted radiance changed
  // Sorted; objects whose emission was switched on or off: they have another material, which
  // differs only in its emission.
  std::vector<uint32_t> switchedObjects;
  bool lights = false;  // punctual lights moved, or changed in more than brightness
  bool sky = false;     // changed in more than brightness
  bool gains = false;   // the brightness of punctual lights or of the sky changed
  // The reference brightness of a light changed (reference_brightness.h), so that its number of
  // samples may be another one.
  bool references = false;

  bool none() const {
    return !surfaces() && !objects && emissions.empty() && switchedObjects.empty() && !lights &&
           !sky && !gains;
  }
  // Whether only the brightness of lights changed.
  bool onlyBrightness() const { return !none() && !surfaces() && !lights && !sky; }
  // The same, in steps that change no light sample.
  bool onlyGains() const { return onlyBrightness() && !references; }
  // Whether anything that receives, reflects or blocks light changed, and not just the light that
  // is emitted.
  bool surfaces() const { return rebuilt || !movedObjects.empty() || materials; }
  // Adds the changes of a later update().
  void merge(const RenderSceneChanges& later);
};

// Updates `render` for the changes of `scene`, in the current unit. Adding, removing, hiding and
// showing nodes changes only their objects; other changes of structure, and everything, rebuild the
// scene. Never throws; a scene without nodes has no objects.
RenderSceneChanges update(RenderScene& render, const Scene& scene, const SceneChanges& changes);

// Rebuilds `render` in another unit. The result is exact: every length is multiplied by a power of
// two.
RenderSceneChanges setUnit(RenderScene& render, const Scene& scene, float unit);

}  // namespace lamplighter
