// What the clamp near VPLs takes away from the live picture, given back once it is settled: the
// refinement's rays to near surfaces, once, from the live VPLs, with what pixels of one surface
// find shared among them (bias_compensation.h). While an edit is on its way the corners of a camera
// at rest keep the share of light that they gained, so that they do not darken and brighten again.
#pragma once

#include <memory>
#include <vector>

#include "renderer/backends/image_pool.h"
#include "renderer/methods/gi_method.h"
#include "renderer/methods/many_lights/bias_compensation.h"

namespace lamplighter {

class LiveBiasCompensation {
 public:
  // The camera moved, or what is shown is another thing: nothing is kept.
  void forget() { *this = LiveBiasCompensation(); }
  // The picture changed: it is to be found anew.
  void outdate() { rows_ = 0; }

  bool isWhole(const View& view) const { return rows_ == view.height; }
  // Goes on by some rows of pixels, as many as a frame has time for.
  void goOn(const FrameInputs& in, const std::vector<InspectedLight>& lights,
            BiasCompensation::Options options);

  // The settled picture with what it lacks; isWhole().
  std::shared_ptr<RadianceImage> addTo(RadianceImage& settled);
  // A picture on its way: each pixel brighter by the share that it had gained when it was settled.
  // The picture itself where nothing is kept.
  std::shared_ptr<RadianceImage> scale(const std::shared_ptr<RadianceImage>& picture);

 private:
  int rows_ = 0;  // found so far
  std::vector<BiasCompensation::Pixel> pixels_;
  Image gains_;  // with it over without it
  ImagePool scaled_;
};

}  // namespace lamplighter
