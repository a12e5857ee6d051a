// A settled picture as the sum of contributions of single lights, so that a change of brightness
// only changes the weights of the sum (the light mix of V-Ray and Corona). Each share is the light
// that surfaces reflect of one control of brightness (light_controls.h) at its reference
// brightness, directly and after bounces, antialiased and with the light of corners.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "renderer/backends/image_pool.h"
#include "renderer/backends/many_lights_kernels.h"
#include "renderer/corner_light/bias_compensation.h"
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
    bool corners = false;
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

  // Whether the memory suffices for a picture of this size, at least with one share for all lights.
  static bool fits(const View& view, size_t bytes);

  // The picture changed in more than the brightness of lights.
  void restart(ManyLightsKernels& kernels);
  // Goes on with the work of a frame. Moves the G-buffer.
  void goOn(const Inputs& in);
  bool isDone() const { return phase_ == Phase::done; }
  // Whether the next goOn() traces the light of corners.
  bool tracesCorners() const { return phase_ == Phase::corners; }
  // Steps until it is done, about one per frame.
  int stepsLeft() const;

  // How the shares add up to the picture of other brightnesses.
  struct Weights {
    std::vector<vec3> ofShares;
    std::vector<vec3> ofControls;  // those of begin(), for what is emitted towards the camera
    // Whether the sum has the bits of a fresh start. Otherwise it has the right brightness, and
    // samples may be shared out otherwise in the end.
    bool isFinal = true;
  };
  // Nothing if the picture is not such a sum: a light changed that shares its share with others
  // because memory is short, or a light is new. Requires isDone().
  std::optional<Weights> weightsFor(const LightControls& controls) const;
  std::shared_ptr<RadianceImage> mix(const View& view, const Weights& weights);
  // The picture before the light of corners and near lamps was added, with the gains of then; empty
  // without it.
  Image takeWithoutCorners() { return std::move(withoutCorners_); }

  int lightsWithoutShare() const { return lightsWithoutShare_; }
  size_t bytes() const;

 private:
  enum class Phase : uint8_t { idle, middle, shifted, corners, done };
  struct Share {
    std::vector<uint32_t> controls;
    Image light;
  };
  void begin(const Inputs& in);
  void sumNext(const Inputs& in);
  bool correctNearLamps(const Inputs& in, vec2 jitter, float weight);
  void keepWithoutCorners(const Inputs& in);
  void traceCorners(const Inputs& in);
  void addCorners(const Inputs& in);  // to the next share
  void mixTo(const Weights& weights, Image& picture) const;

  Phase phase_ = Phase::idle;
  int picture_ = 0, pictures_ = 1;                // the jittered picture in progress
  size_t next_ = 0;                               // the share in progress
  bool hasEmission_ = false;                      // of the picture in progress
  int lampRows_ = 0;                              // rows with near lamps of the picture in progress
  Image nearLamps_;                               // what these change, with the gains of begin()
  std::vector<LightControls::Control> controls_;  // when it began
  std::vector<Share> shares_;
  std::vector<uint32_t> shareOf_;  // by control
  std::vector<vec3> mixedIn_;      // by control of a share for several: its gain; otherwise 1
  EmissionShares emission_;
  int rows_ = 0;            // with corners
  size_t withCorners_ = 0;  // shares to which they were added
  std::vector<BiasCompensation::Pixel> pixels_;
  std::vector<std::vector<BiasCompensation::Contribution>> contributions_;
  Image withoutCorners_;
  ImagePool pool_;
  int lightsWithoutShare_ = 0;
};

}  // namespace lamplighter
