// Pictures of internal data of the engine, made with rays on the CPU. They do not depend on the
// backend, and have the same bits at any number of threads.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "renderer/backends/backend.h"
#include "renderer/debug_views/debug_view.h"
#include "renderer/image/tone_map.h"
#include "renderer/methods/inspection.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

// What the false colour view shows: illuminance of surfaces or luminance of the picture.
struct FalseColour {
  bool isLux = true;
  // Logarithmic from `low` to `high`; both 0: a range that suits the picture.
  float low = 0.0f, high = 0.0f;
  bool operator==(const FalseColour&) const = default;
};

// The input of views. All members must belong to one frame.
struct ViewSubject {
  const RenderScene& scene;
  const RayCaster& rays;
  const View& view;
  const Inspection& inspection;
  int chosenLight = 0;                         // index into inspection.lights
  float exposureEv = 0.0f;                     // exposure of light maps
  ToneMapper toneMapper = ToneMapper::filmic;  // of light maps
  NodeId chosenNode = kNoNode;                 // the light of the lightOcclusion view
  FalseColour falseColour;
  // For falseColour: the radiance of the picture; for illuminance, with all visible surfaces white
  // (FrameInputs::lightOnly).
  const Image* radiance = nullptr;
  std::vector<float> shadowMap;       // of the chosen light sample (ManyLightsKernels)
  std::vector<uint8_t> interpolated;  // ManyLightsKernels::readInterpolated
};

// Why a view cannot be made from this; "": it can.
std::string problemOf(DebugView view, const Inspection& inspection);

// The node of the chosen light sample; kNoNode if it has none (light of the sky).
NodeId nodeOfSample(const Inspection& inspection, int chosenLight);

// Reads from the backend, and from the picture of the frame, only the data that the view needs.
// `radiance` must outlive the use of the subject.
void takeFromBackend(DebugView view, Backend& backend, RadianceImage& radiance,
                     ViewSubject& subject);

// Draws any view that is not radiance (isRadiance). Rays go through the centres of the pixels.
ViewPicture drawView(DebugView view, const ViewSubject& subject);

}  // namespace lamplighter
