// The direct light of each emitter on each element, at its reference brightness: a number per
// emitter, so that brightness and colour need no ray.
#pragma once

#include <optional>
#include <vector>

#include "renderer/sampling/vpl_set.h"
#include "renderer/surface_light/blockers.h"
#include "renderer/surface_light/emitter_factor.h"

namespace lamplighter {

class DirectFactors {
 public:
  struct Scene {
    const RenderScene& scene;
    const RayCaster& rays;
    const LightSet& lights;
    const SurfaceMesh& mesh;
    // By element: whether a part of it is buried or behind a wall. Its light is then found at its
    // corners.
    std::span<const uint8_t> isMixed;
    uint32_t seed;
    int mask;  // places along a side of a flat light whose visibility is found exactly; 0: by rays
  };
  // After changes of the scene. `isNewMesh`: the elements have other numbers. Only what may differ
  // is computed again. `boxes`: bounds of what moved, before and after. Returns the number of rays.
  uint64_t update(const Scene& now, bool isNewMesh, std::span<const uint32_t> movedObjects,
                  std::span<const Bounds> boxes);
  // Irradiance at the corners of the elements with the present brightness of the lights: three for
  // each element [W/m²].
  void sum(const LightSet& lights, std::vector<vec3>& out) const;

  // Of them, how many by masks and how many where nothing is between, without any ray.
  size_t masked() const { return masked_; }
  size_t open() const { return open_; }
  size_t factors() const { return computed_; }  // computed in the last update
  size_t bytes() const;
  void forget() { *this = DirectFactors(); }

 private:
  // The factors of one emitter, by element and corner; of each channel if they differ.
  struct Column {
    VplId id;
    RenderPunctual light;  // without its brightness; of punctual lights
    float reference = 0.0f;
    bool isColoured = false;
    std::vector<float> factors;
  };
  void find(const Scene& now, const std::vector<uint8_t>& isStale, const std::vector<bool>& isMoved,
            std::span<const Bounds> boxes, uint64_t& rays);

  std::vector<Column> columns_;  // by emitter
  std::vector<uint8_t> wasMixed_;
  Sky sky_;  // at its reference brightness
  int mask_ = 0;
  Blockers blockers_;  // if there are masks
  size_t computed_ = 0, masked_ = 0, open_ = 0;
};

}  // namespace lamplighter
