// Which patches a view may show.
#pragma once

#include "renderer/patches/patch_set.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/frustum.h"

namespace lamplighter {

class PotentiallyVisiblePatches {
 public:
  // Pixels may be shifted for smooth edges.
  explicit PotentiallyVisiblePatches(const View& view);

  bool mayShow(const Bounds& box) const { return frustum_.mayMeet(box); }
  bool mayShow(const Patch& patch) const;
  // Whether it may show the side of the chart's patch that its normal points to. Triangles that are
  // turned a little otherwise than the chart are allowed for.
  bool mayShowFront(const Chart& chart, const Patch& patch) const;

 private:
  vec3 eye_;
  Frustum frustum_;
};

}  // namespace lamplighter
