// The low-resolution pass (paper 1, 4.3.3) of the cpu backend: which pixels are samples, which
// cells between them are interpolated, and what is interpolated there.
// shaders/shared/low_resolution.h is the definition.
//
// The samples are a G-buffer of their own, as if of a smaller picture, so that eight of them are
// summed at once. A cell that is not interpolated is summed in whole packets of the picture's
// G-buffer: with blocks of 4 or more a cell is some packets; with blocks of 2 a packet is two
// cells.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/backends/cpu/gbuffer/gbuffer.h"
#include "renderer/backends/cpu/irradiance/irradiance_accumulator.h"

namespace lamplighter::cpu {

struct PictureLight;

class LowResolution {
 public:
  // Takes the samples and looks where cells lie on one surface, in tiles that were traced since the
  // last call. block: 2, 4 or 8 pixels. leftOutBy: of IrradianceAccumulator::update().
  void update(const GBuffer& picture, int block, std::span<const uint32_t> leftOutBy);
  const GBuffer& samples() const { return samples_; }

  // Says which packets are to be summed pixel by pixel, given the light at the samples.
  void findEdges(const GBuffer& picture, const PictureLight& light);
  // Of each tile of the picture, a bit a packet.
  std::span<const uint32_t> edges() const { return edges_; }
  uint64_t pixelsInterpolated() const { return interpolated_; }

  // E [W/m²] of the eight pixels of a packet that is no edge.
  struct Irradiance {
    float r[kLanes], g[kLanes], b[kLanes];
  };
  void interpolate(int tile, int packet, Irradiance& out) const;

  size_t bytes() const { return samples_.bytes(); }

 private:
  // What a cell is; sums of these.
  static constexpr uint8_t kNoPlane = 1, kContrast = 2, kMuchContrast = 4;

  void takeSamples(const GBuffer& picture);
  void findPlanes(const GBuffer& picture, int tile, std::span<const uint32_t> leftOutBy);
  void takeLight(const PictureLight& light, std::span<const uint8_t> isHard, int row);
  void findContrast(int row, bool hasHardLights);
  bool isCutByShadow(uint8_t pairs, size_t at) const;
  uint32_t edgesOf(int tile) const;
  // Cells are in rows with one more all about them, samples in rows with a copy of the last ones.
  size_t cellAt(int i, int j) const {
    return static_cast<size_t>(j + 1) * static_cast<size_t>(cellsX_ + 2) +
           static_cast<size_t>(i + 1);
  }
  size_t rowLength() const { return static_cast<size_t>(samples_.width + kLanes); }

  int width_ = 0, height_ = 0, tilesX_ = 0, tilesY_ = 0;  // of the picture
  int block_ = 0;
  float perBlock_ = 0.0f;
  int cellsX_ = 0, cellsY_ = 0;
  GBuffer samples_;
  std::vector<uint64_t> sampleRevisions_;  // of the picture's tiles, as sampled, by samples' tile
  std::vector<uint64_t> planeRevisions_;   // likewise, as looked at, by the picture's tile
  std::vector<uint8_t> planes_;            // by cell: kNoPlane or 0
  std::vector<uint8_t> pairs_;             // likewise: which kPairs are of one surface, a bit each
  std::vector<uint8_t> cells_;             // by cell, all of it
  std::vector<float> red_, green_, blue_;  // E at samples, row after row
  std::vector<uint8_t> isHard_;            // likewise: there may be hard shadows
  std::vector<uint32_t> edges_;
  uint64_t interpolated_ = 0;
};

}  // namespace lamplighter::cpu
