// Links by which texels receive light from nodes of the tree: form factor times visibility. They
// are refined by geometry alone, so light edits never touch them: a bounce is a sum along the links
// (paper 3 refines by energy in each frame and keeps no links; section 4.3).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "renderer/surface_depths/texel_tree.h"

namespace lamplighter {

// A node, and its share of the light that a texel receives: irradiance over radiosity.
struct TexelLink {
  uint32_t node = 0;
  float weight = 0.0f;
};

// The form factor of a node from a spot, if nothing stands between: that of its square in closed
// form for a leaf near the spot, otherwise cos θ cos θ' A / (π d²).
float formFactorOf(const SurfaceSpot& spot, const TexelSet& texels, const TexelTree& tree,
                   const TexelTree::Node& node);
// At least the form factor of every part of the node, together: the bound of Lightcuts (Walter et
// al. 2005) with a sphere and a cone of normals.
float largestFormFactor(const SurfaceSpot& spot, const TexelTree::Node& node);

// Whether a texel sees a point of a surface; called by several threads.
using Visibility = std::function<bool(uint32_t texel, const vec3& point)>;

class TexelLinks {
 public:
  // Forgets all links. `error`: nodes whose form factor may be larger are refined.
  void restart(const TexelSet& texels, float error);
  // Finds the links of some texels more. The sum of their weights is at most 1. The result does not
  // depend on how many.
  void goOn(const TexelSet& texels, const TexelTree& tree, const Visibility& sees, size_t most);
  bool isDone() const { return next_ == starts_.size() - 1; }
  float progress() const {
    return isDone() ? 1.0f : static_cast<float>(next_) / static_cast<float>(starts_.size() - 1);
  }

  std::span<const TexelLink> of(size_t texel) const {
    return std::span(links_).subspan(starts_[texel], starts_[texel + 1] - starts_[texel]);
  }
  // Irradiance of each texel by the radiosity of the nodes [W/m²].
  void gather(const std::vector<vec3>& radiosity, std::vector<vec3>& irradiance) const;

  size_t size() const { return links_.size(); }
  size_t bytes() const {
    return links_.size() * sizeof(TexelLink) + starts_.size() * sizeof(size_t);
  }

 private:
  float error_ = 0.0f;
  size_t next_ = 0;                // the first texel without links
  std::vector<size_t> starts_{0};  // by texel
  std::vector<TexelLink> links_;
};

}  // namespace lamplighter
