#include "renderer/surface_depths/link_walk.h"

#include <algorithm>
#include <cmath>

namespace lamplighter {
namespace {

// cos(max(0, a − b)) of angles given by sine and cosine, in [0, π].
float cosineOfDifference(float cosA, float sinA, float cosB, float sinB) {
  return cosA >= cosB ? 1.0f : cosA * cosB + sinA * sinB;
}
float sineOf(float cosine) { return std::sqrt(std::max(0.0f, 1.0f - cosine * cosine)); }

}  // namespace

float largestFormFactor(const SurfaceSpot& spot, const TexelTree::Node& node) {
  const vec3 d = node.centre - spot.position;
  const float distance = glm::length(d);
  if (distance <= node.radius) return 1.0f;
  // The sphere is seen within the angle α.
  const float sinA = node.radius / distance, cosA = sineOf(sinA);
  const vec3 w = d / distance;
  const float cosR = glm::dot(spot.normal, w);
  const float here = cosineOfDifference(cosR, sineOf(cosR), cosA, sinA);
  const float length = glm::length(node.normal);
  float there = 1.0f;
  if (length > 0.0f) {
    const float cosS = -glm::dot(node.normal, w) / length;
    const float sinS = sineOf(cosS), sinB = sineOf(node.cosCone);
    // θ − β, then − α.
    const float turned = cosineOfDifference(cosS, sinS, node.cosCone, sinB);
    there = turned >= 1.0f ? 1.0f : cosineOfDifference(turned, sineOf(turned), cosA, sinA);
  }
  if (here <= 0.0f || there <= 0.0f) return 0.0f;
  const float near = distance - node.radius;
  return std::min(1.0f, here * there * node.area / std::max(kPi * near * near, 1e-12f));
}

}  // namespace lamplighter
