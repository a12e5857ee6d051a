// Adds the light that the clamp near VPLs removes to the live picture, once it is settled. It
// traces the refinement's rays to near surfaces once, with the live VPLs, and pixels of one surface
// share their results (bias_compensation.h). During an edit, with the camera at rest, pixels keep
// the relative gain of the settled picture, so that corners do not become dark and bright again;
// but not where an object moved: a lamp that covers a former corner would be twice as bright.
#pragma once

#include <memory>
#include <vector>

#include "renderer/bias_compensation/bias_compensation.h"
#include "renderer/methods/gi_method.h"
#include "renderer/sampling/light_controls.h"
#include "renderer/sampling/light_sample_table.h"

namespace lamplighter {

class LiveBiasCompensation {
 public:
  // Discards everything: the camera moved, or something else is shown.
  void forget() { *this = LiveBiasCompensation(); }
  // The picture changed: the light must be computed again.
  void outdate() { rows_ = 0; }
  // Discards the gains of pixels that may have shown these objects or may show them now.
  void dropGains(const View& view, std::span<const MoverFinder::Mover> movers);

  bool isWhole(const View& view) const { return rows_ == view.height; }
  // Processes the next rows of pixels, as many as fit into a frame.
  void goOn(const FrameInputs& in, const LightSet& emitters, const LightSampleTable& lights,
            const LightControls& controls, BiasCompensation::Options options);

  // The settled picture with the missing light. Requires isWhole().
  std::shared_ptr<RadianceImage> addTo(RadianceImage& settled);
  // Keeps the gains of a settled picture that was completed elsewhere.
  void takeGains(const Image& without, const Image& with);
  // An unsettled picture, each pixel multiplied by its gain in the last settled picture. Returns
  // the picture itself if no gains are kept.
  std::shared_ptr<RadianceImage> scale(Backend& backend,
                                       const std::shared_ptr<RadianceImage>& picture) const;

 private:
  int rows_ = 0;  // rows computed so far
  std::vector<BiasCompensation::Pixel> pixels_;
  Image nearLamps_;  // what near_lamps.h changes
  // Ratio of the picture with this light to the one without it; null: unknown.
  std::shared_ptr<const Image> gains_;
};

}  // namespace lamplighter
