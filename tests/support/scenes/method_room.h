// A room with a box and a lamp, lit by one method: its pictures after edits, and from nothing.
#pragma once

#include <functional>
#include <string>

#include "renderer/image/metrics.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter::test {

struct MethodRoom {
  // `counted`: a statistic of the method that is summed over the frames of a picture, or "".
  explicit MethodRoom(std::string name, std::string counted = "");

  // One frame of the room's own renderer.
  GiOutput frame(const SceneChanges& changes);
  // Renders until the picture is settled; fails the test if it does not settle.
  Image settledBy(FrameRenderer& by, SceneChanges changes, const std::string& with);
  Image picture(const SceneChanges& changes = {}) { return settledBy(renderer, changes, method); }
  Image fresh(const std::string& with);
  Image fresh() { return fresh(method); }
  // Edits the scene only.
  SceneChanges edit(const std::function<void(Scene&)>& change);
  Image edited(const std::function<void(Scene&)>& change) { return picture(edit(change)); }
  // Settled pictures from nothing, means of 4 × 4 pixels, against 1,024 paths per pixel.
  Metrics freshAgainstReference();
  // The picture of a part of the light, from nothing.
  Image freshPart(LightPart part, bool lightOnly = false);
  // Edits of brightness and places, and of materials, one after the other: each leaves the bits of
  // a fresh start, and the first ones together those of before.
  void expectEditsLeaveFreshBits();
  void expectMaterialEditsLeaveFreshBits();

  std::string method, statistic;
  Scene scene;
  NodeId box = kNoNode, lamp = kNoNode;
  View view = lookAt(vec3(1.4f, 0.7f, 1.9f), vec3(0.0f, -0.6f, 0.0f), 64, 48);
  Settings settings;  // two bounces
  FrameRenderer renderer;
  double count = 0.0;  // of the statistic, for the last picture
};

}  // namespace lamplighter::test
