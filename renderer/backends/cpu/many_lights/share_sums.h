// Sums of the light of several groups of lights over the same pictures, separate from the sums of
// the live picture. Where a group lights a surface evenly, jittered pictures use its light from the
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
  // Sums a group at the pixels without jitter; its light stays. Sums about mostLightPixels lights ×
  // pixels, adds them to `counts`, and returns whether it is complete; otherwise the next call must
  // have the same arguments. Then sumSpeculars() follows in the same way.
  bool sumStill(size_t group, const PictureSums::Input& in, int block, uint64_t mostLightPixels,
                SumCounts& counts);
  // The same at jittered pixels. `still`: the G-buffer of its last sumStill().
  bool sumShifted(size_t group, const PictureSums::Input& in, const GBuffer& still,
                  uint64_t mostLightPixels, SumCounts& counts);
  bool sumSpeculars(const PictureSums::Input& in, float leastRoughness, uint64_t mostLightPixels,
                    SumCounts& counts);

  // The weighted sum of the groups, E at the pixels without jitter in the order of the G-buffer.
  std::vector<vec3> total(std::span<const vec3> weights) const;

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
  void begin(size_t group, bool isShifted);
  void keep(const GBuffer& gbuffer, Group& group) const;

  PictureSums& sums() { return isShifted_ ? shifted_ : still_; }
  const PictureSums& sums() const { return isShifted_ ? shifted_ : still_; }

  std::vector<std::unique_ptr<Group>> groups_;
  PictureSums still_, shifted_;  // of both G-buffers, for one group after another
  bool isShifted_ = false;       // of the last sum
  const Group* last_ = nullptr;
  // The incomplete part of the last group; the next group begins afterwards.
  enum class Open : uint8_t { nothing, diffuse, speculars } open_ = Open::nothing;
  std::span<const uint32_t> own_;  // packets of the last sum that do not take the light of last_
};

}  // namespace lamplighter::cpu
