// Conservative test of which patches a view shows.
#pragma once

#include "renderer/patches/patch_set.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/frustum.h"

namespace lamplighter {

class PotentiallyVisiblePatches {
 public:
  // The frustum allows for the pixel offsets of antialiasing.
  explicit PotentiallyVisiblePatches(const View& view);

  bool mayShow(const Bounds& box) const { return frustum_.mayMeet(box); }
  bool mayShow(const Patch& patch) const;
  // Whether the view may show the front of the chart's patch (the side of its normal). Allows for
  // triangles whose normals differ slightly from the chart's.
  bool mayShowFront(const Chart& chart, const Patch& patch) const;

 private:
  vec3 eye_;
  Frustum frustum_;
};

}  // namespace lamplighter
