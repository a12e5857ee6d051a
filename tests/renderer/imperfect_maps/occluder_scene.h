// A level for tests of occluders: bodies of many sizes.
#pragma once

#include "tests/support/scenes/scenes.h"

namespace lamplighter::test {

// A bumpy ball with triangles of many sizes, two instances of a box, a transparent pane and a large
// floor. Nodes 0 to 4; the material of the pane is 1.
inline Scene occluderBodies() {
  Scene scene;
  const int grey = addMaterial(scene, vec3(0.5f)), glass = addMaterial(scene, vec3(1.0f));
  scene.materials[static_cast<size_t>(glass)].transmission = 1.0f;
  addMesh(scene, sphereMesh(1.0f, 16, 0.2f, grey), vec3(0.0f, 1.0f, 0.0f));
  const auto box = boxMesh(vec3(0.5f, 0.2f, 0.1f), grey);
  addMesh(scene, box, vec3(3.0f, 1.0f, 0.0f));
  addMesh(scene, box, vec3(-3.0f, 1.0f, 0.0f));
  addMesh(scene, squareMesh(9.0f, glass), vec3(0.0f, 3.0f, 0.0f));
  addMesh(scene, squareMesh(20.0f, grey));
  return scene;
}

}  // namespace lamplighter::test
