// Moves the camera: fly, orbit, pan, dolly.
#pragma once

#include "editor/tools/viewport_input.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

class CameraController {
 public:
  // Right button: look around; WASD and QE fly, the wheel changes the speed. Middle button: pan.
  // Alt + left button: orbit around the pivot. Wheel: dolly. Returns true if it used the input.
  bool update(View& view, const ViewportInput& input);

  // Moves the camera so that `bounds` fills the view; keeps the direction. `unit`: of lengths that
  // suit the level [m].
  void frame(View& view, const Bounds& bounds, float unit = 1.0f);
  // Call for a new scene: the pivot is `distance` ahead; the speed per second is a fraction of it,
  // from 0.1 to 50 units.
  void reset(float distance, float unit = 1.0f);
  bool flying() const { return flying_; }
  float speed() const { return speed_; }  // m/s

 private:
  float pivotDistance_ = 5.0f;  // metres ahead of the eye
  float speed_ = 3.0f;
  bool flying_ = false, panning_ = false, orbiting_ = false;
  vec2 last_{0.0f};
};

}  // namespace lamplighter
