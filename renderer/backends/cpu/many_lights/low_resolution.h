// The low-resolution pass (paper 1, 4.3.3) of the cpu backend: chooses the sample pixels and the
// cells between them that are interpolated, and interpolates. shaders/shared/low_resolution.h is
// the definition.
//
// The samples have their own G-buffer, like that of a smaller picture, so that eight of them are
// summed at once. A cell that is not interpolated is summed in whole packets of the picture's
// G-buffer: with blocks of 4 or more a cell consists of packets; with blocks of 2 a packet holds
// two cells.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/backends/cpu/composition.h"
#include "renderer/backends/cpu/gbuffer/gbuffer.h"
#include "renderer/backends/cpu/irradiance/irradiance_accumulator.h"

namespace lamplighter::cpu {

class CarriedLight;
struct PictureLight;

class LowResolution {
 public:
  // Takes the samples and tests which cells lie on one surface, in tiles that were traced since the
  // last call. block: 2, 4 or 8 pixels. leftOutBy: as for IrradianceAccumulator::update().
  void update(const GBuffer& picture, int block, std::span<const uint32_t> leftOutBy);
  const GBuffer& samples() const { return samples_; }

  // Finds the packets that must be summed per pixel, from the light at the samples.
  void findEdges(const GBuffer& picture, const PictureLight& light);
  // By tile of the picture, one bit per packet.
  std::span<const uint32_t> edges() const { return edges_; }
  // Those of them that are summed: all, or fewer after limitEdges(). The others take the light of
  // the samples around them that lie on the most similar surface.
  std::span<const uint32_t> summed() const { return summed_; }
  // Packets that are not summed use this light where it is known, instead of interpolated light;
  // null: none. It must stay valid.
  void useCarried(const CarriedLight* carried) { carried_ = carried; }
  // Limits the work at edges: packets × lights that an update of `sums` to these lights takes.
  // Packets that are summed already come first, then those without carried light, and then others
  // in turns. isMoving: the next picture has another view, so there is less to gain.
  void limitEdges(const GBuffer& picture, const IrradianceAccumulator& sums,
                  std::span<const LightRecord> lights, uint64_t mostLightPixels, bool isMoving);
  // Whether there are fewer than all.
  bool isLimited() const { return summed_ != edges_; }
  // Whether there would be fewer, if none had been summed before.
  bool isLong() const { return isLong_; }
  uint64_t pixelsInterpolated() const { return interpolated_; }

  // The samples around a pixel with their weights, which do not add up to 1. Samples on other
  // surfaces than that of the pixel have small weights.
  struct Corner {
    int i = 0, j = 0;    // column and row of samples()
    float share = 0.0f;  // of a bilinear interpolation
    float weight = 0.0f;
  };
  using Corners = std::array<Corner, 4>;
  Corners cornersOf(int x, int y) const;

  // The light of an interpolated packet.
  void interpolate(int tile, int packet, PacketIrradiance& out) const;

  size_t bytes() const { return samples_.bytes(); }

 private:
  // Bits that describe a cell.
  static constexpr uint8_t kNoPlane = 1, kContrast = 2, kMuchContrast = 4;

  void takeSamples(const GBuffer& picture);
  void findPlanes(const GBuffer& picture, int tile, std::span<const uint32_t> leftOutBy);
  void takeLight(const PictureLight& light, std::span<const uint8_t> isHard, int row);
  void findContrast(int row, bool hasHardLights);
  bool isCutByShadow(uint8_t pairs, size_t at) const;
  uint32_t edgesOf(int tile) const;
  void interpolateAtEdge(int tile, int packet, PacketIrradiance& out) const;
  // Cells have a border of one on all sides; the last row and column of samples are duplicated.
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
  // by sample tile: revision of the picture's tile when it was sampled
  std::vector<uint64_t> sampleRevisions_;
  // by tile of the picture: its revision when its planes were tested
  std::vector<uint64_t> planeRevisions_;
  std::vector<uint8_t> planes_;            // by cell: kNoPlane or 0
  std::vector<uint8_t> pairs_;             // by cell: bits of the kPairs that lie on one surface
  std::vector<uint8_t> cells_;             // by cell: all bits
  std::vector<float> red_, green_, blue_;  // E at the samples, row by row
  std::vector<uint8_t> isHard_;            // by sample: there may be hard shadows
  std::vector<uint32_t> edges_, summed_;
  const GBuffer* picture_ = nullptr;  // of the last update()
  const CarriedLight* carried_ = nullptr;
  size_t nextTile_ = 0;  // next tile in turn
  bool isLong_ = false;
  uint64_t interpolated_ = 0;
};

}  // namespace lamplighter::cpu
