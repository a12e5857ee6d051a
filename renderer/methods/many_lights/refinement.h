// Refines a settled picture: the mean of batches of VPLs. Each batch has its own shadow map
// orientation and pixel jitter, and its bias is compensated. It converges to the exact solution.
// The data for the next edit (live VPLs, their maps, light maps, sums) are not touched.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "renderer/backends/many_lights_kernels.h"
#include "renderer/bias_compensation/bias_compensation.h"
#include "renderer/methods/gi_method.h"
#include "renderer/sampling/vpl_set.h"

namespace lamplighter {

class Refinement {
 public:
  struct Options {
    int vpls = 0;      // target number of VPLs, including the live ones; 0: no refinement
    VplCounts counts;  // of the live VPLs
    int mapResolution = 0;
    float clampDistance = 0.0f, shadowBias = 0.0f;
    int lightsPerPass = 1;  // does not change a picture
    bool speculars = false;
    float leastRoughness = 0.1f;
    int mostMaps = 1 << 16;  // in memory

    bool operator==(const Options&) const = default;
  };

  // The number of shadow map slots that it needs, after those of the live VPLs.
  static int slots(const Options& options);

  // Discards the mean, because the settled picture changed.
  void restart();

  // Adds at most `most` VPLs, with maps of this size in consecutive slots from firstSlot. `live`,
  // the settled picture, has the weight of its VPLs. Returns the number of VPLs added.
  int goOn(const FrameInputs& in, ManyLightsKernels& kernels, const Options& options,
           RadianceImage& live, int liveVpls, int firstSlot, MapSize size, int most);

  bool done() const { return done_; }
  int vpls() const { return vpls_; }  // in the mean, including the live ones
  // The mean; null until the first batch is complete.
  const std::shared_ptr<RadianceImage>& image() const { return mean_; }

 private:
  // A batch in progress. Its parts are summed one by one, each scaled as if it were the whole
  // batch.
  struct Batch {
    std::vector<SceneVpl> vpls;
    int samples = 0;  // samples of the VPLs
    int shift = -1;   // index of the jitter in the G-buffer
    vec2 jitter{0.0f};
    std::optional<BiasCompensation> biasCompensation;
    std::vector<BiasCompensation::Pixel> nearPixels;
    size_t summed = 0;
    Image image;
  };
  size_t endOfShift(int shift) const;
  void begin(const FrameInputs& in, const Options& options);
  void addPart(const FrameInputs& in, ManyLightsKernels& kernels, const Options& options,
               int firstSlot, MapSize size, size_t count);
  void finishBatch(int target);

  bool started_ = false, done_ = false;
  VplCounts counts_;
  LightSet lights_;
  int vpls_ = 0;
  Image sum_;
  double weight_ = 0.0;
  std::unique_ptr<Batch> batch_;
  std::shared_ptr<RadianceImage> mean_;
};

}  // namespace lamplighter
