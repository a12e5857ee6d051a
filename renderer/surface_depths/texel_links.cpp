#include "renderer/surface_depths/texel_links.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "renderer/surface_light/form_factor.h"

namespace lamplighter {
namespace {

// Squares nearer than so many of their sides have their form factor in closed form.
constexpr float kNear = 6.0f;
// Texels of a node whose visibility stands for all.
constexpr uint32_t kTested = 4;

// cos(max(0, a − b)) of angles given by sine and cosine, in [0, π].
float cosineOfDifference(float cosA, float sinA, float cosB, float sinB) {
  return cosA >= cosB ? 1.0f : cosA * cosB + sinA * sinB;
}
float sineOf(float cosine) { return std::sqrt(std::max(0.0f, 1.0f - cosine * cosine)); }

}  // namespace

float formFactorOf(const SurfaceSpot& spot, const TexelSet& texels, const TexelTree& tree,
                   const TexelTree::Node& node) {
  const vec3 d = node.centre - spot.position;
  const float d2 = glm::dot(d, d);
  if (node.isLeaf() && d2 < kNear * kNear * node.area) {
    const SurfaceTexel& t = texels[tree.texelOf(node)];
    if (glm::dot(t.spot.geometricNormal, spot.position - t.spot.position) <= 0.0f) return 0.0f;
    return polygonFactor(spot.position, spot.normal, t.square()) / kPi;
  }
  if (!(d2 > 0.0f) || (!node.isLeaf() && d2 <= node.radius * node.radius)) return 0.0f;
  const float scale = 1.0f / std::sqrt(d2);
  const float here = glm::dot(spot.normal, d) * scale, there = -glm::dot(node.normal, d) * scale;
  if (here <= 0.0f || there <= 0.0f) return 0.0f;
  return here * there * node.area / (kPi * d2);
}

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

void TexelLinks::restart(const TexelSet& texels, float error) {
  *this = {};
  error_ = error;
  starts_.assign(texels.size() + 1, 0);
}

void TexelLinks::goOn(const TexelSet& texels, const TexelTree& tree, const Visibility& sees,
                      size_t most) {
  const size_t count = std::min(most, starts_.size() - 1 - next_);
  std::vector<std::vector<TexelLink>> found(count);
  tbb::parallel_for(size_t{0}, count, [&](size_t i) {
    const auto texel = static_cast<uint32_t>(next_ + i);
    const SurfaceSpot& spot = texels[texel].spot;
    for (uint32_t n = 0; n < tree.size();) {
      const TexelTree::Node& node = tree[n];
      const float largest = largestFormFactor(spot, node);
      if (!node.isLeaf() && largest > error_) {
        ++n;
        continue;
      }
      const uint32_t number = n;
      n = node.skip;
      if (largest <= 0.0f || (node.isLeaf() && tree.texelOf(node) == texel)) continue;
      const float factor = formFactorOf(spot, texels, tree, node);
      if (factor <= 0.0f) continue;
      const uint32_t tested = std::min(node.texels, kTested);
      uint32_t seen = 0;
      for (uint32_t k = 0; k < tested; ++k) {
        const uint32_t sender =
            tree.order()[node.firstTexel + (2 * k + 1) * node.texels / (2 * tested)];
        seen += sees(texel, texels[sender].spot.position) ? 1 : 0;
      }
      if (seen > 0)
        found[i].push_back(
            {number, factor * static_cast<float>(seen) / static_cast<float>(tested)});
    }
  });
  for (size_t i = 0; i < count; ++i) {
    // More than all of the hemisphere is seen where surfaces coincide.
    float sum = 0.0f;
    for (const TexelLink& link : found[i]) sum += link.weight;
    if (sum > 1.0f)
      for (TexelLink& link : found[i]) link.weight /= sum;
    links_.insert(links_.end(), found[i].begin(), found[i].end());
    starts_[next_ + i + 1] = links_.size();
  }
  next_ += count;
}

void TexelLinks::gather(const std::vector<vec3>& radiosity, std::vector<vec3>& irradiance) const {
  irradiance.assign(starts_.size() - 1, vec3(0.0f));
  tbb::parallel_for(size_t{0}, irradiance.size(), [&](size_t t) {
    if (t >= next_) return;
    vec3 sum(0.0f);
    for (const TexelLink& link : of(t)) sum += link.weight * radiosity[link.node];
    irradiance[t] = sum;
  });
}

}  // namespace lamplighter
