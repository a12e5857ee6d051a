// The points near a complex object where incident light is sampled. The paper samples at one point,
// and its figure 4-14 shows the error: a shadow boundary never falls across the object. It suggests
// a grid (4.4.2). Here the points are spread over the surface, where the light is needed, and each
// vertex blends the nearest ones.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/prt/transfer.h"

namespace lamplighter {

inline constexpr int kMostLightPoints = 255;

struct IncidentLightPoints {
  static constexpr size_t kBlended = 4;
  struct Blend {
    std::array<uint8_t, kBlended> point{};
    std::array<float, kBlended> weight{};  // the sum is 1; unused entries are 0
  };
  std::vector<vec3> places;  // in the object's own space
  std::vector<Blend> ofVertex;
  // largest distance of a vertex from its nearest point, in units of that space
  float spacing = 0.0f;
};

// The number of points for an object whose bounding box has this longest side [m]: proportional to
// its surface, 64 at 1 m, in [1, `most`].
int lightPointsFor(float size, int most);

// A single point is the centre of the bounds, as in the paper. Several points are vertices, each
// the farthest one from those before it (Gonzalez 1985), moved inwards by a tenth, so that they are
// not inside what the object stands on. (Rays ignore the object itself.) Deterministic.
IncidentLightPoints placeIncidentLightPoints(const RenderScene& own, int count);

}  // namespace lamplighter
