// A place to look from that the user put by, under a number; saved as a note of the scene.
#pragma once

#include "renderer/base/math.h"

namespace lamplighter {

inline constexpr int kCameraBookmarks = 9;

struct CameraBookmark {
  int slot = 1;  // 1 to kCameraBookmarks
  vec3 eye{0.0f};
  quat orientation{1.0f, 0.0f, 0.0f, 0.0f};  // as View's
  float yfov = 0.9f;                         // radians, vertical
  bool operator==(const CameraBookmark&) const = default;
};

}  // namespace lamplighter
