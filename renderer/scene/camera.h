// A pinhole camera with an image size.
#pragma once

#include "renderer/base/math.h"
#include "renderer/scene/scene.h"

namespace lamplighter {

struct View {
  vec3 eye{0.0f, 1.0f, 5.0f};
  quat orientation{1.0f, 0.0f, 0.0f, 0.0f};  // looks along −Z, up is Y
  float yfov = 0.9f;                         // radians, vertical
  int width = 640;
  int height = 360;
  float znear = 0.01f;  // metres

  vec3 right() const { return orientation * vec3(1, 0, 0); }
  vec3 up() const { return orientation * vec3(0, 1, 0); }
  vec3 forward() const { return orientation * vec3(0, 0, -1); }
  float aspect() const { return static_cast<float>(width) / static_cast<float>(height); }
  mat4 worldToView() const;
  // Reversed Z with an infinite far plane: clip-space depth is 1 at znear and 0 at infinity.
  mat4 viewToClip() const;
  mat4 worldToClip() const { return viewToClip() * worldToView(); }
  // Unit direction through the image point (x, y) [px]; (0.5, 0.5) is the centre of the top-left
  // pixel.
  vec3 rayDirection(float x, float y) const;
  // The same without normalisation: linear in x and y, with a component of 1 along forward().
  vec3 rayPlane(float x, float y) const;
  // Image position of a world-space point [px], y down; w ≤ 0 behind the eye.
  vec3 project(const vec3& world) const;  // x, y, distance along forward()

  bool operator==(const View&) const = default;
};

// The view of a scene's camera node at the given size.
View viewOfCamera(const Scene& scene, const Node& node, int width, int height);
// A view from slightly above that shows all of `bounds`, for a scene without a camera.
View viewOfBounds(const Bounds& bounds, int width, int height);

}  // namespace lamplighter
