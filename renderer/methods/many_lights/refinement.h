// What a picture at rest becomes: the mean of batches of VPLs of their own, each with its maps
// turned otherwise, its pixels shifted otherwise, and what the clamp took away given back. It
// converges to the light itself, and what is kept for the next edit (live VPLs, their maps, light
// maps, sums) is left alone.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "renderer/methods/gi_method.h"
#include "renderer/methods/many_lights/bias_compensation.h"
#include "renderer/sampling/vpl_set.h"

namespace lamplighter {

class Refinement {
 public:
  struct Options {
    int vpls = 0;  // in all, the live ones included, to which the picture is refined; 0: not at all
    VplCounts counts;  // of the live ones
    int mapResolution = 0;
    float clampDistance = 0.0f, shadowBias = 0.0f;
    int lightsPerPass = 1;  // changes no picture
    bool speculars = false;
    float leastRoughness = 0.1f;
    int mostMaps = 1 << 16;  // at a time

    bool operator==(const Options&) const = default;
  };

  // Shadow maps that it needs, behind those of the live VPLs.
  static int slots(const Options& options);

  // What it was to be the mean of is shown no more.
  void restart();

  // Goes on by at most `most` VPLs with maps of this size in the slots from firstSlot on. `live`,
  // the settled picture, counts for as many VPLs as it has. Returns how many VPLs it went on by.
  int goOn(const FrameInputs& in, const Options& options, RadianceImage& live, int liveVpls,
           int firstSlot, MapSize size, int most);

  bool done() const { return done_; }
  int vpls() const { return vpls_; }  // in the mean, the live ones included
  // The mean; null while no batch is complete.
  const std::shared_ptr<RadianceImage>& image() const { return mean_; }

 private:
  // One on its way: parts of it are summed, each as if it were all.
  struct Batch {
    std::vector<SceneVpl> vpls;
    int samples = 0;  // that they are
    int shift = -1;   // of the pixels, the one that the G-buffer has
    vec2 jitter{0.0f};
    std::optional<BiasCompensation> biasCompensation;
    std::vector<BiasCompensation::Pixel> nearPixels;
    size_t summed = 0;
    Image image;
  };
  size_t endOfShift(int shift) const;
  void begin(const FrameInputs& in, const Options& options);
  void addPart(const FrameInputs& in, const Options& options, int firstSlot, MapSize size,
               size_t count);
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
