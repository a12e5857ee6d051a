// Sums of the light of several groups of lights over the same pictures, apart from the sums of the
// live picture. Where a group lights a surface evenly, jittered pictures take its light from the
// picture without jitter (adaptive_antialiasing.h).
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "renderer/backends/cpu/many_lights/adaptive_antialiasing.h"
#include "renderer/backends/cpu/many_lights/picture_sums.h"

namespace lamplighter::cpu {

class ShareSums {
 public:
  // Sums a group at the pixels without jitter; its light stays until dropShares().
  SumCounts sumStill(size_t group, const PictureSums::Input& in, int block);
  // Sums it at jittered pixels. `still`: the G-buffer of its last sumStill().
  SumCounts sumShifted(size_t group, const PictureSums::Input& in, const GBuffer& still);
  // As PictureSums::sumSpeculars(), for the picture of the last sum.
  uint64_t sumSpeculars(const PictureSums::Input& in, float leastRoughness);

  // The light of the last sum, as PacketLight.
  PacketIrradianceView at(int tile, int packet) const;
  const SpecularAccumulator& speculars() const { return sums().speculars; }

  void forgetPlaces() {
    still_.forgetPlaces();
    shifted_.forgetPlaces();
  }
  size_t bytes() const;

 private:
  struct Group {
    std::vector<float> r, g, b;    // E at the pixels without jitter, in the order of the G-buffer
    AdaptiveAntialiasing sharing;  // with jittered pictures
  };
  void keep(const GBuffer& gbuffer, Group& group) const;

  PictureSums& sums() { return isShifted_ ? shifted_ : still_; }
  const PictureSums& sums() const { return isShifted_ ? shifted_ : still_; }

  std::vector<std::unique_ptr<Group>> groups_;
  PictureSums still_, shifted_;  // of both G-buffers, for one group after another
  bool isShifted_ = false;       // of the last sum
  const Group* last_ = nullptr;
  std::span<const uint32_t> own_;  // packets of the last sum that do not take the light of last_
};

}  // namespace lamplighter::cpu
