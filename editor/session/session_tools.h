// The tools of a session, for session*.cpp only.
#pragma once

#include "editor/session/session.h"
#include "editor/tools/camera_controller.h"
#include "editor/tools/light_handles.h"

namespace lamplighter {

struct Session::Tools {
  CameraController camera;
  Gizmo gizmo;
  LightHandles lightHandles;
  vec2 pointer{0.0f};  // last position over the viewport
  bool pointerKnown = false;
};

}  // namespace lamplighter
