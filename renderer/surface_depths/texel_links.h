// Links by which texels receive light from nodes of the tree: form factor times visibility.
// Refinement depends on geometry only, so edits of lights do not change links; a bounce is a sum
// along the links (paper 3 refines by energy in each frame and keeps no links; section 4.3).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "renderer/surface_depths/former_links.h"

namespace lamplighter {

// The form factor of a node from a spot, without occlusion: the closed form of its square for a
// leaf near the spot, otherwise cos θ cos θ' A / (π d²).
float formFactorOf(const SurfaceSpot& spot, const TexelSet& texels, const TexelTree& tree,
                   const TexelTree::Node& node);
// Whether a texel sees a point of a surface (world space). Must be thread-safe.
using Visibility = std::function<bool(uint32_t texel, const vec3& point)>;

class TexelLinks {
 public:
  // Discards all links. `error`: nodes whose form factor may be larger are replaced by their
  // children.
  void restart(const TexelSet& texels, float error);
  // After some objects moved: links are computed again, but the visibility of links that do not
  // meet a moved object is kept. `before`: the old tree; `texels`, `tree`: the current ones.
  void restart(const TexelTree& before, const TexelSet& texels, const TexelTree& tree,
               TexelMoves moves);
  // Computes the links of up to `most` more texels. The sum of the shares of a texel is at most 1.
  // The result does not depend on `most` or on reused visibility.
  void goOn(const TexelSet& texels, const TexelTree& tree, const Visibility& sees, size_t most);
  bool isDone() const { return next_ == count_; }
  // Texels before this one have their links.
  size_t found() const { return next_; }
  float progress() const {
    return isDone() ? 1.0f : static_cast<float>(next_) / static_cast<float>(count_);
  }

  // The links of a texel before found(). The irradiance of the texel per radiosity of a node is the
  // weight of the link times scaleOf().
  std::span<const TexelLink> of(size_t texel) const { return table_.of(texel); }
  float scaleOf(size_t texel) const { return scales_[texel]; }
  // Computes the irradiance of each texel from the radiosity of the nodes [W/m²].
  void gather(const std::vector<vec3>& radiosity, std::vector<vec3>& irradiance) const;

  size_t size() const { return table_.links.size(); }
  size_t bytes() const { return table_.bytes() + former_.bytes(); }
  // Segments that the last goOn() tested, and those whose visibility was reused.
  uint64_t tested() const { return tested_; }
  uint64_t known() const { return known_; }

 private:
  float error_ = 0.0f;
  size_t count_ = 0, next_ = 0;  // texels, and the first one without links
  LinkTable table_;              // of the texels before next_
  std::vector<float> scales_;    // of those texels
  FormerLinks former_;           // only while links are computed
  uint64_t tested_ = 0, known_ = 0;
};

}  // namespace lamplighter
