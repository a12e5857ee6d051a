// A camera position that the user saved under a number; stored in the extras of the scene.
#pragma once

#include "renderer/base/math.h"

namespace lamplighter {

inline constexpr int kCameraBookmarks = 9;

struct CameraBookmark {
  int slot = 1;  // 1 to kCameraBookmarks
  vec3 eye{0.0f};
  quat orientation{1.0f, 0.0f, 0.0f, 0.0f};  // as in View
  float yfov = 0.9f;                         // radians, vertical
  bool operator==(const CameraBookmark&) const = default;
};

}  // namespace lamplighter
