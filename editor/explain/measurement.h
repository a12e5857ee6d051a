// Measures the distance between two surface points.
#pragma once

#include <optional>
#include <string>

#include "editor/tools/overlay.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

class Measurement {
 public:
  // Sets the first point, then the second. A third call starts a new measurement.
  void add(const vec3& point);
  // The surface point under the pointer; a line follows it. None: the pointer is not on a surface.
  void hover(const std::optional<vec3>& point) { hovered_ = point; }
  void clear() { *this = Measurement(); }

  bool hasBegun() const { return from_.has_value(); }
  bool isComplete() const { return to_.has_value(); }
  // The vector from the first point to the second, or to the point under the pointer [m]. None:
  // there are not two points.
  std::optional<vec3> offset() const;
  // "2.350 m  (dx +1.000  dy -0.500  dz +0.000 m)"; "" while there are not two points.
  std::string text() const;
  void draw(Overlay& overlay, const View& view) const;

 private:
  std::optional<vec3> from_, to_, hovered_;
};

}  // namespace lamplighter
