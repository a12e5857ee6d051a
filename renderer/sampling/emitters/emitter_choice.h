// Chooses the emissive surface that a path samples: near and strong ones more often. For each cell
// of the scene, in proportion to flux divided by squared distance (the importance of Conty Estevez
// and Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", 2018), and a tenth
// by flux only, because near lamps may be hidden.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

struct Emitter;

class EmitterChoice {
 public:
  // Chooses among the emitters that are surfaces and have flux; there must be at least one.
  EmitterChoice(const RenderScene& scene, std::span<const Emitter> emitters);

  // For light that arrives at a point: chooses an index of the emitters by a random number.
  int choose(const vec3& place, float u, float& probability) const;
  float probability(const vec3& place, int emitter) const;

 private:
  size_t cellOf(const vec3& place) const;
  // For a cell: cumulative probabilities of the emitters; the last is 1.
  std::span<const float> sumsOf(size_t cell) const {
    return std::span(sums_).subspan(cell * emitters_.size(), emitters_.size());
  }
  static float partOf(std::span<const float> sums, size_t k) {
    return k == 0 ? sums[0] : sums[k] - sums[k - 1];
  }

  std::vector<int> emitters_;         // emitters that may be chosen
  std::vector<uint32_t> indexAmong_;  // by emitter: its index in emitters_
  Bounds bounds_;
  glm::ivec3 cells_{1};
  float side_ = 1.0f;        // of a cell [m]
  std::vector<float> sums_;  // by cell, then by emitter
};

}  // namespace lamplighter
