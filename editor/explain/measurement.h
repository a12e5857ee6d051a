// The distance between two points of surfaces.
#pragma once

#include <optional>
#include <string>

#include "editor/tools/overlay.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

class Measurement {
 public:
  // The first point, then the second; the next one begins anew.
  void add(const vec3& point);
  // Where the pointer is on a surface, for a line that follows it; none: it is on nothing.
  void hover(const std::optional<vec3>& point) { hovered_ = point; }
  void clear() { *this = Measurement(); }

  bool hasBegun() const { return from_.has_value(); }
  bool isComplete() const { return to_.has_value(); }
  // From the first to the second point, or to that under the pointer [m]; none: there are not two.
  std::optional<vec3> offset() const;
  // "2.350 m  (dx +1.000  dy -0.500  dz +0.000 m)"; "" while there are not two points.
  std::string text() const;
  void draw(Overlay& overlay, const View& view) const;

 private:
  std::optional<vec3> from_, to_, hovered_;
};

}  // namespace lamplighter
