// The light of emissive surfaces and of the sky that the camera sees, separately for each
// brightness control (light_controls.h).
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "renderer/image/image.h"
#include "renderer/methods/gi_method.h"
#include "renderer/sampling/light_controls.h"

namespace lamplighter {

class EmissionShares {
 public:
  void clear() { *this = EmissionShares(); }
  // Adds the picture of the G-buffer that was rendered last, shifted by `jitter` and multiplied by
  // `weight`.
  void add(const FrameInputs& in, const LightControls& controls, vec2 jitter, float weight);
  // Adds all shares to a picture, with the gain of each control.
  void addTo(Image& picture, std::span<const vec3> gains) const;

 private:
  // By pixel, in order: radiance at the reference brightness [W/(m² sr)].
  using Pixels = std::vector<std::pair<uint32_t, vec3>>;

  std::vector<Pixels> ofControl_;
};

}  // namespace lamplighter
