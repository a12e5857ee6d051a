// Weighted means of pixels that show the same surface: a step of an à-trous transform (Dammertz et
// al., "Edge-Avoiding À-Trous Wavelet Transform for fast Global Illumination Filtering", 2010).
#pragma once

#include <array>
#include <cstdlib>

#include <tbb/parallel_for.h>

#include "renderer/image/rows.h"
#include "renderer/path_repair/repair_guides.h"

namespace lamplighter {

// Calls f(x, y, index) for all pixels of these rows that show a surface, in parallel.
template <typename F>
void forSurfaces(const RepairGuides& guides, Rows rows, const F& f) {
  tbb::parallel_for(rows.first, rows.last, [&](int y) {
    for (int x = 0; x < guides.width; ++x) {
      const auto i = static_cast<size_t>(y * guides.width + x);
      if (guides.normal[i] != vec3(0.0f)) f(x, y, i);
    }
  });
}

// Means over pixels at a distance of 0 or `step` in each direction: T::add(weight, T) sums, then
// T::divide(sum of weights). Weights fall with the angle between normals and with the distance off
// the plane of the pixel, and T::trust(neighbour) scales them. `to`: receives these rows.
template <typename T>
void takeSurfaceMeans(const RepairGuides& guides, Rows rows, const std::vector<T>& from, int step,
                      std::vector<T>& to) {
  // Linear B-spline, by distance from the middle.
  constexpr std::array<float, 2> kSpline{0.5f, 0.25f};
  forSurfaces(guides, rows, [&](int x, int y, size_t i) {
    const vec3 normal = guides.normal[i], position = guides.position[i];
    // Points with a distance of `step` pixels or more from the plane have no weight.
    const float tolerance = 1.0f / (guides.footprint[i] * static_cast<float>(step));
    T sum = T::nothing();
    float all = 0.0f;
    for (int dy = -1; dy <= 1; ++dy) {
      const int v = y + dy * step;
      if (v < 0 || v >= guides.height) continue;
      for (int dx = -1; dx <= 1; ++dx) {
        const int u = x + dx * step;
        if (u < 0 || u >= guides.width) continue;
        const auto k = static_cast<size_t>(v * guides.width + u);
        const float cosine = glm::dot(normal, guides.normal[k]);
        if (cosine <= 0.0f) continue;
        const float off = glm::dot(normal, guides.position[k] - position) * tolerance;
        const float near = 1.0f - off * off;
        if (near <= 0.0f) continue;
        float turn = cosine;
        for (int power = 1; power < 32; power *= 2) turn *= turn;
        const float weight = kSpline[static_cast<size_t>(std::abs(dx))] *
                             kSpline[static_cast<size_t>(std::abs(dy))] * near * near * turn *
                             from[i].trust(from[k]);
        sum.add(weight, from[k]);
        all += weight;
      }
    }
    sum.divide(all);
    to[i] = sum;
  });
}

}  // namespace lamplighter
