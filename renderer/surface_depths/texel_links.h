// Links by which texels receive light from nodes of the tree: form factor times visibility. They
// are refined by geometry alone, so light edits never touch them: a bounce is a sum along the links
// (paper 3 refines by energy in each frame and keeps no links; section 4.3).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "renderer/surface_depths/former_links.h"

namespace lamplighter {

// The form factor of a node from a spot, if nothing stands between: that of its square in closed
// form for a leaf near the spot, otherwise cos θ cos θ' A / (π d²).
float formFactorOf(const SurfaceSpot& spot, const TexelSet& texels, const TexelTree& tree,
                   const TexelTree::Node& node);
// Whether a texel sees a point of a surface; called by several threads.
using Visibility = std::function<bool(uint32_t texel, const vec3& point)>;

class TexelLinks {
 public:
  // Forgets all links. `error`: nodes whose form factor may be larger are refined.
  void restart(const TexelSet& texels, float error);
  // After some objects moved: links are found anew, but where they and the objects that moved are
  // apart, what was seen stays. `before`, `texels`: the trees and texels of then and now.
  void restart(const TexelTree& before, const TexelSet& texels, const TexelTree& tree,
               TexelMoves moves);
  // Finds the links of some texels more. The sum of their shares is at most 1. The result does not
  // depend on how many, or on what was seen before.
  void goOn(const TexelSet& texels, const TexelTree& tree, const Visibility& sees, size_t most);
  bool isDone() const { return next_ == count_; }
  // Texels up to this one, without it, have their links.
  size_t found() const { return next_; }
  float progress() const {
    return isDone() ? 1.0f : static_cast<float>(next_) / static_cast<float>(count_);
  }

  // Of a texel whose links are found. The share of light that it receives along a link, irradiance
  // over radiosity, is the weight times scaleOf().
  std::span<const TexelLink> of(size_t texel) const { return table_.of(texel); }
  float scaleOf(size_t texel) const { return scales_[texel]; }
  // Irradiance of each texel by the radiosity of the nodes [W/m²].
  void gather(const std::vector<vec3>& radiosity, std::vector<vec3>& irradiance) const;

  size_t size() const { return table_.links.size(); }
  size_t bytes() const { return table_.bytes() + former_.bytes(); }
  // Segments of the last goOn() that were tested, and those of which the answer was known.
  uint64_t tested() const { return tested_; }
  uint64_t known() const { return known_; }

 private:
  float error_ = 0.0f;
  size_t count_ = 0, next_ = 0;  // texels, and the first one without links
  LinkTable table_;              // of the texels before next_
  std::vector<float> scales_;    // of those texels
  FormerLinks former_;           // while links are found
  uint64_t tested_ = 0, known_ = 0;
};

}  // namespace lamplighter
