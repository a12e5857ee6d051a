// A closed room with a box and a lamp. It is so small that a quarter of it is closer to a wall than
// the clamp distance.
#pragma once

#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter::test {

struct SmallRoom {
  Scene scene;
  NodeId box = kNoNode, lamp = kNoNode;
  View view = lookAt(vec3(1.2f, 1.6f, 1.3f), vec3(-0.4f, 0.7f, -0.5f), 64, 48, 1.1f);

  SmallRoom() {
    const int white = addMaterial(scene, vec3(0.7f, 0.6f, 0.5f));
    addMesh(scene, roomMesh(vec3(3, 2.4f, 3), white), vec3(0, 1.2f, 0));
    box = addMesh(scene, boxMesh(vec3(0.7f), white), vec3(-0.5f, 0.35f, -0.5f));
    lamp = addRectangleLight(scene, vec3(0.2f, 2.2f, 0.1f), vec2(0.8f, 0.6f), vec3(10, 8, 6));
  }
};

}  // namespace lamplighter::test
