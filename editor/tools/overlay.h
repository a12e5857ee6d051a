// Lines and marks that tools and views draw over the viewport through the ui. Coordinates are
// viewport pixels, y down.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "renderer/base/math.h"

namespace lamplighter {

// Colour of the handle under the pointer.
inline const vec4 kHoverColour{1.0f, 0.85f, 0.3f, 1.0f};

struct OverlayShape {
  std::vector<vec2> points;
  bool closed = false;
  bool filled = false;
  vec4 colour{1.0f};       // sRGB, straight alpha
  float thickness = 1.5f;  // px
};

struct OverlayText {
  vec2 position{0.0f};
  std::string text;  // lines are separated by \n
  vec4 colour{1.0f};
  bool boxed = false;  // on a dark background, readable over any picture
};

// Triangles with colours that are interpolated between their corners.
struct OverlayMesh {
  std::vector<vec2> points;
  std::vector<vec4> colours;        // by point; sRGB, straight alpha
  std::vector<uint32_t> triangles;  // three points each
};

struct Overlay {
  std::vector<OverlayShape> shapes;  // in drawing order
  std::vector<OverlayText> texts;
  std::vector<OverlayMesh> meshes;  // in drawing order, below the shapes
};

}  // namespace lamplighter
