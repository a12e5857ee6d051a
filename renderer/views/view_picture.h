// Pictures of what the engine keeps, made of rays on the processor: the same whatever backend
// lights the level, and with the same bits at any number of threads.
#pragma once

#include <string>
#include <vector>

#include "renderer/image/image.h"
#include "renderer/image/tone_map.h"
#include "renderer/methods/inspection.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/view.h"
#include "renderer/views/debug_view.h"

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

  bool empty() const { return swatches.empty() && ramp.empty(); }
};

struct ViewPicture {
  Image8 image;  // to be shown as it is
  Legend legend;
  std::string problem;  // why it cannot be made and `image` is the flat view instead; "": it can
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
};

// Why a view cannot be made of this; "": it can.
std::string problemOf(DebugView view, const Inspection& inspection);

// Any view that is no radiance (isRadiance). Rays go through the middles of the pixels.
ViewPicture drawView(DebugView view, const ViewSubject& subject);

}  // namespace lamplighter
