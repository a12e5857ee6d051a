#include "renderer/surface_depths/texel_links.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/surface_depths/link_walk.h"
#include "renderer/surface_light/form_factor.h"

namespace lamplighter {
namespace {

// Distance, in sides of the square, below which its form factor is computed in closed form.
constexpr float kNear = 6.0f;

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

void TexelLinks::restart(const TexelSet& texels, float error) {
  *this = {};
  error_ = error;
  count_ = texels.size();
}

void TexelLinks::restart(const TexelTree& before, const TexelSet& texels, const TexelTree& tree,
                         TexelMoves moves) {
  // Incomplete links cannot be used; the older ones can.
  FormerLinks former =
      isDone() ? FormerLinks(before, std::move(table_), error_) : std::exchange(former_, {});
  restart(texels, error_);
  former_ = std::move(former);
  if (!former_.empty()) former_.compareWith(tree, std::move(moves));
}

using Known = FormerLinks::OfTexel::Known;

void TexelLinks::goOn(const TexelSet& texels, const TexelTree& tree, const Visibility& sees,
                      size_t most) {
  const size_t count = std::min(most, count_ - next_);
  std::vector<std::vector<TexelLink>> found(count);
  std::atomic<uint64_t> tested = 0, ofKnown = 0;
  tbb::parallel_for(size_t{0}, count, [&](size_t i) {
    const auto texel = static_cast<uint32_t>(next_ + i);
    const SurfaceSpot& spot = texels[texel].spot;
    FormerLinks::OfTexel former = former_.of(texel, spot);
    uint64_t asked = 0, kept = 0;
    for (uint32_t n = 0; n < tree.size();) {
      const TexelTree::Node& node = tree[n];
      const Known known = former.at(n, tree, spot);
      if (known == Known::links) {
        former.append(n, found[i]);
        n = node.skip;
        continue;
      }
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
      const uint32_t before = known == Known::ends ? former.seen(number) : 0;
      uint32_t places = 0, seen = 0;
      forEachTested(tree, node, [&](uint32_t sender) {
        const uint32_t k = places++;
        const vec3& point = texels[sender].spot.position;
        const vec3 from = spot.rayOrigin();
        const bool isKept =
            known == Known::ends && !former_.moves().meets({from, 0.0f, point - from, 1.0f});
        const bool isSeen = isKept ? (before >> k & 1u) != 0 : sees(texel, point);
        seen |= isSeen ? 1u << k : 0u;
        ++(isKept ? kept : asked);
      });
      if (seen != 0)
        found[i].push_back(
            {number, seen,
             factor * static_cast<float>(std::popcount(seen)) / static_cast<float>(places)});
    }
    tested += asked;
    ofKnown += kept;
  });
  tested_ = tested;
  known_ = ofKnown;
  for (size_t i = 0; i < count; ++i) {
    // The visible shares exceed 1 if surfaces coincide.
    float sum = 0.0f;
    for (const TexelLink& link : found[i]) sum += link.weight;
    scales_.push_back(sum > 1.0f ? 1.0f / sum : 1.0f);
    table_.links.insert(table_.links.end(), found[i].begin(), found[i].end());
    table_.starts.push_back(table_.links.size());
  }
  next_ += count;
  if (isDone()) former_ = {};
}

void TexelLinks::gather(const std::vector<vec3>& radiosity, std::vector<vec3>& irradiance) const {
  irradiance.assign(count_, vec3(0.0f));
  tbb::parallel_for(size_t{0}, next_, [&](size_t t) {
    vec3 sum(0.0f);
    for (const TexelLink& link : of(t)) sum += link.weight * radiosity[link.node];
    irradiance[t] = scales_[t] * sum;
  });
}

}  // namespace lamplighter
