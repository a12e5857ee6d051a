#include "renderer/scene/ies/ies_profile.h"

#include <algorithm>
#include <cmath>

namespace lamplighter {

namespace {

// Finds the interval of a list that contains an angle: the index before it, and the fraction to the
// next. False if the angle is outside the list. A list with one entry applies to every angle.
bool locate(const std::vector<float>& angles, float angle, size_t& index, float& way) {
  index = 0;
  way = 0.0f;
  if (angles.size() == 1) return true;
  // Tolerance at both ends, so that rounding errors cause no black line.
  constexpr float kSlack = 1e-3f;
  if (angle < angles.front() - kSlack || angle > angles.back() + kSlack) return false;
  const auto after = std::upper_bound(angles.begin() + 1, angles.end() - 1, angle);
  index = static_cast<size_t>(after - angles.begin()) - 1;
  way = std::clamp((angle - angles[index]) / (angles[index + 1] - angles[index]), 0.0f, 1.0f);
  return true;
}

// Maps an angle around the nadir, [0, 360), to the range of the file by symmetry.
float folded(const std::vector<float>& planes, float angle) {
  const float last = planes.back();
  if (planes.front() == 90.0f) {  // half, symmetric about the plane from C90 to C270
    if (angle < 90.0f) return 180.0f - angle;
    return angle > 270.0f ? 540.0f - angle : angle;
  }
  if (last <= 180.0f && angle > 180.0f) angle = 360.0f - angle;
  if (last <= 90.0f && angle > 90.0f) angle = 180.0f - angle;
  return angle;
}

}  // namespace

float IesProfile::atTilt(const vec3& aim) const {
  if (tiltAngles.empty()) return 1.0f;
  const float angle = std::acos(std::clamp(-aim.y, -1.0f, 1.0f)) * (180.0f / kPi);
  size_t index;
  float way;
  locate(tiltAngles, std::clamp(angle, tiltAngles.front(), tiltAngles.back()), index, way);
  const size_t next = std::min(index + 1, tiltFactors.size() - 1);
  return glm::mix(tiltFactors[index], tiltFactors[next], way);
}

float IesProfile::at(const vec3& d) const {
  constexpr float kDegrees = 180.0f / kPi;
  float h, v;
  if (isTypeB) {
    h = std::asin(std::clamp(d.x, -1.0f, 1.0f)) * kDegrees;
    v = std::atan2(d.y, -d.z) * kDegrees;
    if (horizontal.front() >= 0.0f) h = std::abs(h);
    if (vertical.front() >= 0.0f) v = std::abs(v);
  } else {
    v = std::acos(std::clamp(-d.z, -1.0f, 1.0f)) * kDegrees;
    h = std::atan2(d.y, d.x) * kDegrees;
    h = folded(horizontal, h < 0.0f ? h + 360.0f : h);
  }
  size_t row, column;
  float down, across;
  if (!locate(vertical, v, row, down) || !locate(horizontal, h, column, across)) return 0.0f;
  const auto value = [&](size_t c, size_t r) { return values[c * vertical.size() + r]; };
  const size_t nextRow = std::min(row + 1, vertical.size() - 1);
  const size_t nextColumn = std::min(column + 1, horizontal.size() - 1);
  const float here = glm::mix(value(column, row), value(column, nextRow), down);
  const float there = glm::mix(value(nextColumn, row), value(nextColumn, nextRow), down);
  return glm::mix(here, there, across);
}

}  // namespace lamplighter
