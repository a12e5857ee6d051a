// Pictures of what the engine keeps, made of rays on the processor: the same whatever backend
// lights the level, and with the same bits at any number of threads.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "renderer/backends/kernels.h"
#include "renderer/debug_views/debug_view.h"
#include "renderer/image/image.h"
#include "renderer/image/tone_map.h"
#include "renderer/methods/inspection.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

// What the colours of a picture mean. Colours are the display's.
struct Legend {
  struct Swatch {
    vec3 colour{0.0f};
    std::string label;
  };
  std::string title;
  std::vector<Swatch> swatches;
  std::vector<vec3> ramp;  // evenly from `low` to `high`; empty: none
  std::string low, high;
  // Besides or instead of these: what stands at places of the ramp, from 0 to 1.
  std::vector<std::pair<float, std::string>> ticks;

  bool empty() const { return swatches.empty() && ramp.empty(); }
};

struct ViewPicture {
  Image8 image;  // to be shown as it is
  Legend legend;
  std::string problem;  // why it cannot be made and `image` is the flat view instead; "": it can
};

// What false colour shows: illuminance of the surfaces, or luminance of the picture.
struct FalseColour {
  bool isLux = true;
  // Logarithmic from `low` to `high`; both 0: what suits the picture.
  float low = 0.0f, high = 0.0f;
  bool operator==(const FalseColour&) const = default;
};

// What views are made from. All must be of one frame.
struct ViewSubject {
  const RenderScene& scene;
  const RayCaster& rays;
  const View& view;
  const Inspection& inspection;
  int chosenLight = 0;                         // index into inspection.lights
  float exposureEv = 0.0f;                     // at which light maps are shown
  ToneMapper toneMapper = ToneMapper::filmic;  // likewise
  NodeId chosenNode = kNoNode;                 // the light that lightOcclusion is about
  FalseColour falseColour;
  // For falseColour: the radiance of the picture; in lux as if what is seen were white
  // (FrameInputs::lightOnly).
  const Image* radiance = nullptr;
  std::vector<float> shadowMap;       // of the chosen light sample (Backend::readShadowMap)
  std::vector<uint8_t> interpolated;  // Backend::readInterpolated
};

// Why a view cannot be made of this; "": it can.
std::string problemOf(DebugView view, const Inspection& inspection);

// The node of the chosen light sample, kNoNode where there is none: light of the sky.
NodeId nodeOfSample(const Inspection& inspection, int chosenLight);

// Reads what the view shows of the backend and of the frame's picture, and of no more than it
// shows. `radiance` must outlive the subject's use.
void takeFromBackend(DebugView view, Backend& backend, RadianceImage& radiance,
                     ViewSubject& subject);

// Any view that is no radiance (isRadiance). Rays go through the middles of the pixels.
ViewPicture drawView(DebugView view, const ViewSubject& subject);

}  // namespace lamplighter
