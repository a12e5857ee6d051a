// The points that the pixels of a picture showed, for finding them in a later view.
#pragma once

#include <vector>

#include "renderer/backends/cpu/gbuffer/gbuffer.h"

namespace lamplighter::cpu {

struct SeenPoints {
  View view;
  // In the order of the G-buffer.
  std::vector<float> px, py, pz;  // world position [m]
  std::vector<uint32_t> object;
  std::vector<uint8_t> hit;

  void take(const GBuffer& gbuffer, const View& seenFrom);
  size_t bytes() const { return px.size() * (3 * sizeof(float) + sizeof(uint32_t) + 1); }
};

}  // namespace lamplighter::cpu
