// A settled picture as the sum of contributions of single lights, so that a change of brightness
// only changes the weights of the sum (the light mix of V-Ray and Corona). Each share is the light
// that surfaces reflect of one control of brightness (light_controls.h) at its reference
// brightness, directly and after bounces, antialiased and with bias compensation.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "renderer/backends/image_pool.h"
#include "renderer/backends/many_lights_kernels.h"
#include "renderer/bias_compensation/bias_compensation.h"
#include "renderer/light_maps/light_proxies.h"
#include "renderer/methods/many_lights/emission_shares.h"
#include "renderer/sampling/light_sample_table.h"
#include "renderer/visibility/visibility_database.h"

namespace lamplighter {

class LightShares {
 public:
  struct Options {
    size_t bytes = 0;   // of memory
    int antialias = 1;  // pictures with shifted pixels; 1: only the picture without jitter
    shared::ShadingParams shading;
    bool mergePasses = false;
    bool isCompensated = false;
    BiasCompensation::Options corner;  // without groups
  };
  struct Inputs {
    const FrameInputs& frame;
    ManyLightsKernels& kernels;
    const LightSet& emitters;
    const LightSampleTable& lights;  // all up to date
    const LightControls& controls;
    const VisibilityDatabase* visibility;  // null: naive
    const LightProxies::Groups& groups;
    const Options& options;
  };

  // Whether the memory limit allows a picture of this size with at least one share for all lights.
  static bool fits(const View& view, size_t bytes);

  // Call when the picture changed in more than the brightness of lights.
  void restart(ManyLightsKernels& kernels);
  // Does the work of one frame. Changes the G-buffer.
  void goOn(const Inputs& in);
  bool isDone() const { return phase_ == Phase::done; }
  // Whether the next goOn() compensates the bias.
  bool compensatesBias() const { return phase_ == Phase::compensation; }
  // Approximate number of steps until it is done, about one per frame.
  int stepsLeft() const;

  // Weights with which the shares add up to a picture with other brightnesses.
  struct Weights {
    std::vector<vec3> ofShares;
    std::vector<vec3> ofControls;  // for the controls of begin(): emission towards the camera
    // Whether the sum is bitwise equal to that of a new start. If not, its brightness is right, but
    // a new start may distribute the samples differently.
    bool isFinal = true;
  };
  // None if the picture is not such a sum: a light changed that has a common share with others
  // because of the memory limit, or a light is new. Requires isDone().
  std::optional<Weights> weightsFor(const LightControls& controls) const;
  std::shared_ptr<RadianceImage> mix(const View& view, const Weights& weights);
  // The picture before bias compensation and near lamps were added, with the gains at that time;
  // empty without them.
  Image takeUncompensated() { return std::move(uncompensated_); }

  int lightsWithoutShare() const { return lightsWithoutShare_; }
  size_t bytes() const;

 private:
  enum class Phase : uint8_t { idle, middle, shifted, compensation, done };
  struct Share {
    std::vector<uint32_t> controls;
    Image light;
  };
  void begin(const Inputs& in);
  void sumNext(const Inputs& in);
  bool correctNearLamps(const Inputs& in, vec2 jitter, float weight);
  void keepUncompensated(const Inputs& in);
  void traceCompensation(const Inputs& in);
  void addCompensation(const Inputs& in);  // to the next share
  void mixTo(const Weights& weights, Image& picture) const;

  Phase phase_ = Phase::idle;
  int picture_ = 0, pictures_ = 1;  // the jittered picture in progress
  size_t next_ = 0;                 // the share in progress
  bool hasEmission_ = false;        // of the picture in progress
  int lampRows_ = 0;                // rows with near lamps of the picture in progress
  Image nearLamps_;                 // the change by near lamps, with the gains of begin()
  std::vector<LightControls::Control> controls_;  // when it began
  std::vector<Share> shares_;
  std::vector<uint32_t> shareOf_;  // by control
  std::vector<vec3> mixedIn_;      // by control of a share for several: its gain; otherwise 1
  EmissionShares emission_;
  int rows_ = 0;            // that are compensated
  size_t compensated_ = 0;  // number of shares with bias compensation
  std::vector<BiasCompensation::Pixel> pixels_;
  std::vector<std::vector<BiasCompensation::Contribution>> contributions_;
  Image uncompensated_;
  ImagePool pool_;
  int lightsWithoutShare_ = 0;
};

}  // namespace lamplighter
