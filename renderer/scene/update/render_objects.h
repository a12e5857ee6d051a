// Fills and empties the objects of a RenderScene.
#pragma once

#include <memory>
#include <vector>

#include "renderer/scene/light_linking.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

// Input for the objects of a document, by node.
struct SceneState {
  // unit: of the lengths of a RenderScene [m].
  SceneState(const Scene& scene, float unit);

  float unit = 1.0f;
  std::vector<mat4> world;  // gives positions in this unit
  std::vector<bool> visible, shining;
  LightLinks links;
};

// An object that the document has, visible or hidden.
struct WantedObject {
  size_t node = 0;                   // index into Scene::nodes
  std::shared_ptr<const Mesh> mesh;  // null: the surface of the area light
  uint32_t primitive = 0;            // of the mesh
};
// In the order of nodes and primitives. Primitives without triangles are left out.
std::vector<WantedObject> wantedObjects(const Scene& scene);

// Memory for more vertices and indices, so that appending an object seldom moves all of them.
void reserveObjects(RenderScene& render, size_t vertices, size_t indices);

// Appends an empty object. Returns its index.
uint32_t appendObject(RenderScene& render, const Scene& scene, const WantedObject& wanted);
// Shows an empty object. Does not set its material.
void fillObject(RenderScene& render, const Scene& scene, const SceneState& state,
                const WantedObject& wanted, uint32_t object);
// Writes the vertices of an object again, after its node moved.
void placeObject(RenderScene& render, const Node& node, const mat4& world, uint32_t object);
void emptyObject(RenderScene& render, uint32_t object);

}  // namespace lamplighter
