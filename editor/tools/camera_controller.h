// Moves the view: fly, orbit, pan, dolly.
#pragma once

#include "editor/tools/viewport_input.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

class CameraController {
 public:
  // Right button: look around, WASD and QE fly, wheel changes the speed. Middle: pan. Alt + left:
  // orbit about the pivot. Wheel: dolly. True when it used the input.
  bool update(View& view, const ViewportInput& input);

  // Looks at `bounds` from where the view looks now.
  void frame(View& view, const Bounds& bounds);
  // A new scene: the pivot lies `distance` ahead, speed is a share of it a second.
  void reset(float distance);
  bool flying() const { return flying_; }
  float speed() const { return speed_; }  // m/s

 private:
  float pivotDistance_ = 5.0f;  // metres ahead of the eye
  float speed_ = 3.0f;
  bool flying_ = false, panning_ = false, orbiting_ = false;
  vec2 last_{0.0f};
};

}  // namespace lamplighter
