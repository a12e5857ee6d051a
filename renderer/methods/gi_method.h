// The interface behind which every global-illumination method stands, the path tracer too.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "renderer/backends/kernels.h"
#include "renderer/base/parameters.h"
#include "renderer/methods/inspection.h"
#include "renderer/methods/light_part.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

// A stage's time is measured by a stopwatch that the caller supplies (null: not measured), so that
// nothing in here reads a clock; it never decides anything.
using Stopwatch = std::function<double()>;  // seconds since some fixed moment

// What a method is given for one frame. The scene and rays are up to date when render() is called.
struct FrameInputs {
  const RenderScene& scene;
  const RenderSceneChanges& changes;  // since the frame before
  const RayCaster& rays;
  const View& view;
  Backend& backend;  // its scene is up to date too
  const Settings& settings;
  uint32_t frame = 0;  // counts from 0
  Stopwatch stopwatch;
  bool lightOnly = false;  // what is seen is shown as if it were white; bounces are as ever
  // What takes seconds to prepare may be ready some frames later; else it is waited for, so that
  // every frame is the same each time.
  bool inBackground = false;
  std::filesystem::path cacheFolder;  // for what is prepared; empty: it is not kept
  // Light samples by which a settled picture may be refined in this frame; 0: it stays as it is.
  int refineUpdates = 0;
  LightPart part = LightPart::all;  // that the picture shows; parts are not refined
};

struct GiStats {
  int vpls = 0;                  // shown
  int vplsPending = 0;           // not yet what the scene asks for
  int mapsPending = 0;           // of them, those whose map must be rendered
  int mapsToSharpen = 0;         // once nothing is pending: maps that are to become fine ones
  int oldestFrames = 0;          // frames the oldest pending one has waited
  int framesUntilSettled = 0;    // at this frame's pace, if nothing else changes
  int vplsRefreshed = 0;         // this frame
  int mapsRendered = 0;          // this frame, but for fine ones
  int mapsSharpened = 0;         // this frame: fine ones rendered
  int mapsHeld = 0;              // of VPLs that are shown
  int mapsWithoutRoom = 0;       // that are looked up and do not fit: others stand in
  uint64_t visibilityNeeds = 0;  // bytes, where it has no room and is left out; else 0
  int mapsSpared = 0;            // this frame: what moved is hidden from their lights
  // Paths of bounced light, this frame: looked at anew by rays, of these such as meet something
  // else now, as they were; and those that wait to be.
  int pathsWalked = 0, pathsReplaced = 0, pathsKept = 0, pathsPending = 0;
  uint64_t raysTraced = 0;       // this frame, by the method itself
  uint64_t visibilityTests = 0;  // this frame: occlusion pyramids against the scene
  uint64_t lightMapTexels = 0;   // this frame: texels × lights added or taken away
  float lightMapTexel = 0.0f;    // spacing, as memory allows [m]; 0: there are no light maps
  // Of the last sum, where passes are merged: drawn, and fewer than object by object.
  int mergedPasses = 0, passesSaved = 0;
  float interpolatedShare = 0.0f;  // of the last sum's pixels: by the low-resolution pass
  int transfersPending = 0;        // objects' transfers that are being prepared
  float transferShare = 1.0f;      // that is done of the first of them
  // Objects with transfer; those of them whose direct light is all summed at pixels, since transfer
  // would get too much of it wrong; and lights that are, counted once for each of the others. And
  // objects without transfer for want of memory.
  int transferObjects = 0, transferObjectsLeft = 0, transferLightsLeft = 0;
  int transferObjectsWithoutRoom = 0;
  int samplesPerPixel = 0;
  // A settled picture that is refined: VPLs it is the mean of, those it is to be, and how many came
  // nearer this frame.
  int vplsRefined = 0, vplsToRefine = 0, mapsRefined = 0;
  std::map<std::string, double> stageSeconds;   // by stage name
  std::map<std::string, uint64_t> memoryBytes;  // of what the method keeps, by what it is
};

struct GiOutput {
  std::shared_ptr<RadianceImage> radiance;
  bool includesDirect = true;
  bool settled = false;  // rendering the same inputs again changes nothing but to refine it
  bool refined = true;   // nor that: it is refined as far as was asked for, or not at all
  GiStats stats;
};

class GiMethod {
 public:
  virtual ~GiMethod() = default;
  virtual GiOutput render(const FrameInputs& in) = 0;
  // Forgets everything kept between frames.
  virtual void reset() = 0;
  // For views of what it keeps; good until the next call of the others.
  virtual Inspection inspect() const { return {}; }
};

struct MethodInfo {
  std::string name;      // as in --method
  std::string label;     // as in the panel
  std::string citation;  // the paper
  std::vector<ParameterSpec> parameters;
  std::function<std::unique_ptr<GiMethod>()> make;
};

}  // namespace lamplighter
