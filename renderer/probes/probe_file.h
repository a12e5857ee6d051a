// Light probes as files for engines: a text with the grid and all probes, and a volume of pixels.
// The user guide describes both. Lengths in the files are in metres.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "renderer/probes/probe_light.h"

namespace lamplighter {

struct ProbeFileNotes {
  std::string volume;    // name of the file with the volume
  float unit = 1.0f;     // of the grid's lengths [m]: RenderScene::unit
  float padding = 0.0f;  // unit of the scene
  int samples = 0;       // paths per probe
  int bounces = 0;
};

// The JSON text. `light`: of all probes of the grid, with invalid ones filled in (fillInvalid).
// Numbers are the shortest that read back as the same float. Throws InputError if a number is not
// finite.
std::string probeText(const ProbeGrid& grid, std::span<const ProbeSh> light,
                      const ProbeFileNotes& notes);

// An EXR, 32-bit float RGBA, of 9 · size.x by size.y · size.z pixels. Coefficient i of node (x, y,
// z) is in column i · size.x + x and row z · size.y + y, counted from the upper left. Alpha: 1 for
// valid probes, 0 for filled ones.
std::vector<uint8_t> probeVolume(const ProbeGrid& grid, std::span<const ProbeSh> light);

// "valid", "inside", "near", "outside" or "dark".
const char* nameOf(ProbeState state);

}  // namespace lamplighter
