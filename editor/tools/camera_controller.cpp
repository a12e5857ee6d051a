#include "editor/tools/camera_controller.h"

#include <algorithm>
#include <cmath>

namespace lamplighter {

namespace {

constexpr float kRadiansPerPixel = 0.0045f;
constexpr float kDollyPerNotch = 0.88f;
constexpr float kSpeedPerNotch = 1.2f;
constexpr float kSteepest = 1.55f;  // largest pitch [rad], just below straight up

// Rotates by yaw around the world's Y axis and by pitch around the view's X axis. The horizon stays
// level.
quat turned(const quat& orientation, float yaw, float pitch) {
  const vec3 forward = orientation * vec3(0, 0, -1);
  const float oldPitch = std::asin(std::clamp(forward.y, -1.0f, 1.0f));
  // When looking straight up or down, the up vector gives the heading.
  const vec3 up = orientation * vec3(0, 1, 0);
  const vec3 heading =
      std::abs(forward.y) < 0.999f ? forward : -std::copysign(1.0f, forward.y) * up;
  const float oldYaw = std::atan2(-heading.x, -heading.z);
  const float newPitch = std::clamp(oldPitch + pitch, -kSteepest, kSteepest);
  return glm::angleAxis(oldYaw + yaw, vec3(0, 1, 0)) * glm::angleAxis(newPitch, vec3(1, 0, 0));
}

}  // namespace

bool CameraController::update(View& view, const ViewportInput& in) {
  const vec2 delta = in.pointer - last_;
  last_ = in.pointer;
  if (in.pressed[1]) flying_ = true;
  if (in.pressed[2]) panning_ = true;
  if (in.pressed[0] && in.modifiers.alt) orbiting_ = true;
  flying_ = flying_ && in.down[1];
  panning_ = panning_ && in.down[2];
  orbiting_ = orbiting_ && in.down[0];
  const bool began = in.pressed[0] || in.pressed[1] || in.pressed[2];

  if (flying_) {
    if (!began)
      view.orientation =
          turned(view.orientation, -delta.x * kRadiansPerPixel, -delta.y * kRadiansPerPixel);
    speed_ *= std::pow(kSpeedPerNotch, in.wheel);
    vec3 way(0.0f);
    const auto axis = [&](Key plus, Key minus, const vec3& direction) {
      way += direction * static_cast<float>(static_cast<int>(in.keys.contains(plus)) -
                                            static_cast<int>(in.keys.contains(minus)));
    };
    axis(Key::w, Key::s, view.forward());
    axis(Key::d, Key::a, view.right());
    axis(Key::e, Key::q, vec3(0, 1, 0));
    const float fast = in.modifiers.shift ? 4.0f : 1.0f;
    if (glm::length(way) > 0.0f) view.eye += glm::normalize(way) * speed_ * fast * in.seconds;
    return true;
  }
  if (panning_) {
    if (!began) {
      const float metresPerPixel =
          2.0f * std::tan(0.5f * view.yfov) * pivotDistance_ / static_cast<float>(view.height);
      view.eye += (-delta.x * view.right() + delta.y * view.up()) * metresPerPixel;
    }
    return true;
  }
  if (orbiting_) {
    if (!began) {
      const vec3 pivot = view.eye + pivotDistance_ * view.forward();
      view.orientation =
          turned(view.orientation, -delta.x * kRadiansPerPixel, -delta.y * kRadiansPerPixel);
      view.eye = pivot - pivotDistance_ * view.forward();
    }
    return true;
  }
  if (in.hovered && in.wheel != 0.0f) {
    const float closer = pivotDistance_ * std::pow(kDollyPerNotch, in.wheel);
    view.eye += (pivotDistance_ - closer) * view.forward();
    pivotDistance_ = std::max(closer, 4.0f * view.znear);
    return true;
  }
  return false;
}

void CameraController::frame(View& view, const Bounds& bounds, float unit) {
  if (bounds.empty()) return;
  const float radius = std::max(bounds.radius(), 0.05f * unit);
  const float narrow = std::tan(0.5f * view.yfov) * std::min(1.0f, view.aspect());
  pivotDistance_ = 1.05f * radius / std::sin(std::atan(narrow));
  view.eye = bounds.centre() - pivotDistance_ * view.forward();
}

void CameraController::reset(float distance, float unit) {
  pivotDistance_ = std::max(distance, 0.01f * unit);
  speed_ = std::clamp(0.6f * distance, 0.1f * unit, 50.0f * unit);
  flying_ = panning_ = orbiting_ = false;
}

}  // namespace lamplighter
