// The main method (paper 1, chapter 4): every VPL with its shadow map at every pixel, or look-ups
// only where the visibility database cannot decide.
#pragma once

#include <memory>
#include <optional>

#include "renderer/backends/many_lights_kernels.h"
#include "renderer/light_maps/light_maps.h"
#include "renderer/light_maps/light_proxies.h"
#include "renderer/methods/bounced_picture.h"
#include "renderer/methods/field_light/field_picture.h"
#include "renderer/methods/gi_method.h"
#include "renderer/methods/imperfect_light/imperfect_picture.h"
#include "renderer/methods/linked_picture.h"
#include "renderer/methods/many_lights/light_shares.h"
#include "renderer/methods/many_lights/live_bias_compensation.h"
#include "renderer/methods/many_lights/live_lights.h"
#include "renderer/methods/many_lights/options.h"
#include "renderer/methods/many_lights/part_lights.h"
#include "renderer/methods/many_lights/refinement.h"
#include "renderer/methods/many_lights/statistics.h"
#include "renderer/methods/stage_timer.h"
#include "renderer/prt/prt_lights.h"
#include "renderer/sampling/choice/lamp_importance.h"
#include "renderer/sampling/choice/point_visibility.h"
#include "renderer/sampling/light_controls.h"
#include "renderer/sampling/light_paths.h"
#include "renderer/visibility/visibility_database.h"

namespace lamplighter {

class ManyLights final : public GiMethod {
 public:
  // `transfer`: how radiance transfer is computed.
  explicit ManyLights(ManyLightsKernels& kernels, Transfers::Compute transfer = computeTransfer)
      : kernels_(&kernels), computeTransfer_(std::move(transfer)) {}

  GiOutput render(const FrameInputs& in) override;
  void reset() override { *this = ManyLights(*kernels_, std::move(computeTransfer_)); }
  Inspection inspect() const override;
  // Sets whether the direct light of emissive surfaces is computed elsewhere; if so, they get no
  // light samples.
  void leaveOutSurfaces(bool areLeftOut) { withoutSurfaces_ = areLeftOut; }
  // Whether the backend has the G-buffer of the view without a shift. Must be set by code that
  // draws another G-buffer between frames.
  bool& gbufferIsCurrent() { return gbufferIsCurrent_; }
  const LinkedPicture& linked() const { return linked_; }
  const FieldPicture& field() const { return field_; }
  // Work on light on surfaces in the last frame.
  const SurfaceLight::Counts& surfaceCounts() const { return meshes_.counts(); }

 private:
  using Options = ManyLightsOptions;

  GiOutput renderSamples(const FrameInputs& in, Options& options, StageTimer& stages,
                         ManyLightsStats& stats);
  void addLinks(const FrameInputs& in, const Options& options, StageTimer& stages, GiOutput& out,
                ManyLightsStats& stats);
  void addField(const FrameInputs& in, const Options& options, StageTimer& stages, GiOutput& out,
                ManyLightsStats& stats);
  void addImperfect(const FrameInputs& in, const Options& options, StageTimer& stages,
                    GiOutput& out, ManyLightsStats& stats);
  void addMeshes(const FrameInputs& in, const Options& options, StageTimer& stages, GiOutput& out,
                 ManyLightsStats& stats);
  void takeScene(const FrameInputs& in, const Options& options);
  void updateLights(const FrameInputs& in, const Options& options, ManyLightsStats& stats);
  std::shared_ptr<RadianceImage> shade(const FrameInputs& in, const Options& options, vec2 jitter,
                                       StageTimer& stages);
  LightSampleTable takePart(const FrameInputs& in, const Options& options, bool isNew);
  void shareLamps(const FrameInputs& in, const Options& options, const View& view, bool isEditing);
  int refreshLights(const Options& options);
  void askForPatches(const FrameInputs& in, const Options& options);
  void updateVisibility(const FrameInputs& in, Options& options, ManyLightsStats& stats);
  void updateMaps(const FrameInputs& in, const Options& options, ManyLightsStats& stats);
  void sharpenMaps(const Options& options, ManyLightsStats& stats);
  LightMaps::Options lightMapOptions(const Options& options) const;
  void updateLightMaps(const FrameInputs& in, const Options& options, ManyLightsStats& stats);
  bool updatePrt(const FrameInputs& in, const Options& options, ManyLightsStats& stats);
  bool usesShares(const FrameInputs& in, const Options& options) const;
  bool isSamePicture(const FrameInputs& in, const Options& options) const;
  bool isAtRest() const;
  bool mixOnly(const FrameInputs& in, const Options& options, GiOutput& out,
               ManyLightsStats& stats);
  void restartShares();
  void goOnWithShares(const FrameInputs& in, const Options& options, StageTimer& stages);
  void mixShares(const FrameInputs& in, const LightShares::Weights& weights);
  void refineSettled(const FrameInputs& in, const Options& options, bool shadedNow,
                     StageTimer& stages, GiOutput& out, ManyLightsStats& stats);
  SmoothEdges smoothEdges() const;
  void count(const FrameInputs& in, const Options& options, const GiOutput& out,
             ManyLightsStats& stats) const;
  void refine(const FrameInputs& in, const Options& options, StageTimer& stages, GiOutput& out,
              ManyLightsStats& stats);
  std::shared_ptr<RadianceImage> compensateBias(const FrameInputs& in, const Options& options,
                                                const std::shared_ptr<RadianceImage>& picture,
                                                bool isSmooth, StageTimer& stages);
  void addSample(const FrameInputs& in, const Options& options, StageTimer& stages);

  ManyLightsKernels* kernels_;  // of the backend
  Transfers::Compute computeTransfer_;
  bool started_ = false, lightOnly_ = false, withoutSurfaces_ = false;
  float lightMapTexel_ = 0.0f;  // spacing in the picture [m]
  LightPart part_ = LightPart::all;
  PartLights partLights_;  // if only a part is shown
  Options options_;        // of the previous frame
  View view_;
  std::optional<View> chosenFor_;  // the view for which VPLs were chosen by importance, if any
  bool choiceIsCurrent_ = true;    // chosenFor_ is the current view, not an earlier one
  LightPaths paths_;
  PointVisibility pointVisibility_;    // from the view for which VPLs are chosen
  LampImportance lampImportance_;      // from the same view
  std::vector<LampShare> lampShares_;  // distribution of direct samples; empty: by flux
  std::vector<VplId> lampIds_;         // their emitters
  bool lampsAreCurrent_ = true;        // lampShares_ are those of a new start
  LiveLights lights_;
  int mapSlots_ = 0;  // slots in the backend, with their maps
  Options::MapRooms mapRooms_;
  std::unique_ptr<VisibilityDatabase> visibility_;  // if enabled
  PatchDemand demand_;                              // patches that were requested from the database
  bool demandIsCurrent_ = false;                    // it depends only on the current scene and view
  bool patchesChanged_ = false;                     // since the last sum
  size_t visibilityNeeds_ = 0;                      // bytes, lower bound of the last attempt
  int neededFor_ = 0;                               // number of slots of that attempt
  LightProxies lightProxies_;                       // for VPLs without a map
  std::unique_ptr<LightMaps> lightMaps_;            // if enabled
  std::unique_ptr<PrtLights> prt_;                  // if enabled
  bool gbufferIsCurrent_ = false;
  // sumIsLimited_: the last sum left pixels to later frames. isLimited_: it left pixels or
  // highlights. isLong_: a sum from scratch would leave some.
  bool sumIsLimited_ = false, isLimited_ = false, isLong_ = false;
  bool isHasty_ = false;                  // the camera moves: fewer samples, more interpolation
  std::shared_ptr<RadianceImage> image_;  // picture with unjittered pixels
  // Values of BackendCounts and ManyLightsCounts before this frame.
  uint64_t waitsBefore_ = 0, uploadsBefore_ = 0;
  int mergedPasses_ = 0, passesSaved_ = 0;  // of the last sum
  float interpolatedShare_ = 0.0f;          // of the last sum
  // Antialiasing: the sum of the samples so far; their mean when they are complete.
  Image sum_;
  int samples_ = 0;
  std::shared_ptr<RadianceImage> mean_;
  LightControls controls_;                // of the present scene
  LightShares shares_;                    // of the settled picture
  std::shared_ptr<RadianceImage> mixed_;  // from them
  bool imageIsStale_ = false;             // lacks changes of brightness that were mixed
  // mixed_ is shown until new shares are complete; the current shares are of other samples.
  bool holdsMix_ = false, sharesAreOld_ = false;
  RenderSceneChanges unsampled_;  // changes that the light samples do not have yet
  LiveBiasCompensation compensation_;
  std::shared_ptr<RadianceImage> whole_;  // the settled picture with bias compensation
  Refinement refinement_;
  BouncedPicture meshes_;       // with indirect = meshes
  LinkedPicture linked_;        // with indirect = links
  FieldPicture field_;          // with indirect = field
  ImperfectPicture imperfect_;  // with indirect = imperfect
};

MethodInfo manyLightsInfo();

}  // namespace lamplighter
