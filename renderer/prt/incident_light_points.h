// Where on a complex object the light about it is sampled. The paper samples at one point, and its
// figure 4-14 shows what that costs: a shadow's boundary never falls across the object. It names a
// grid as the way out (4.4.2). Here the points are spread over the surface, where the light
// is wanted, and vertices blend those nearest to them.
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
    std::array<float, kBlended> weight{};  // sum 1; 0 where there are fewer
  };
  std::vector<vec3> places;  // in the object's own space
  std::vector<Blend> ofVertex;
  float spacing = 0.0f;  // no vertex is farther from its nearest point, in units of that space
};

// How many points an object of this size (the longest side of its box [m]) gets: in
// proportion to its surface, 64 for a metre, from 1 to `most`.
int lightPointsFor(float size, int most);

// One point is the middle of the bounds, as in the paper. More are vertices, each the one that is
// farthest from those before (Gonzalez 1985), pulled a tenth inwards, so that they are not in what
// the object stands on: rays pass through the object itself. Deterministic.
IncidentLightPoints placeIncidentLightPoints(const RenderScene& own, int count);

}  // namespace lamplighter
