// Bounced light by many samples with imperfect shadow maps, added to a picture.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "renderer/imperfect_maps/bidirectional_importance.h"
#include "renderer/imperfect_maps/light_choice.h"
#include "renderer/imperfect_maps/occluder_points.h"
#include "renderer/imperfect_maps/visible_importance.h"
#include "renderer/methods/gi_method.h"
#include "renderer/methods/imperfect_light/exact_sum.h"

namespace lamplighter {

// Called when a stage of stages.h ends; the next one begins.
using EndStage = std::function<void(const StageSpec&)>;

class ImperfectPicture {
 public:
  // Call in each frame. Follows changes of the scene and the view.
  void update(const FrameInputs& in, const ImperfectParameters& wanted, const EndStage& endStage);
  // The direct light of a frame.
  struct Direct {
    std::shared_ptr<RadianceImage> picture;
    bool isSettled = false;
    std::vector<SceneVpl> lights;  // light samples of the direct light; only if it is settled
    bool* gbufferIsCurrent;  // whether the backend has the G-buffer of the view without a shift
  };
  // Returns the picture plus the bounced light. When it is settled, the exact sum is computed over
  // several frames, with `antialias` subpixel shifts.
  std::shared_ptr<RadianceImage> addTo(const FrameInputs& in, const Direct& direct, int antialias,
                                       const SurfacePictureOptions& options,
                                       const EndStage& endStage);
  // Whether the last picture shows the exact sum.
  bool isDone() const { return exact_.isDone(); }
  int framesLeft() const;
  void forget() { *this = ImperfectPicture(); }

  const ReflectiveMap& map() const { return map_; }
  const std::vector<float>& importance() const { return importance_; }
  const ChosenLights& lights() const { return chosen_; }
  std::span<const MapLight> mapLights() const { return lights_; }
  const OccluderPoints& points() const { return points_; }
  const View& view() const { return view_; }
  const ImperfectParameters& parameters() const { return parameters_; }
  // Whether there is any light; then scene() and rays() are those of the last frame.
  bool isReady() const { return isStarted_ && !lights_.empty(); }
  const RenderScene& scene() const { return *scene_; }
  const RayCaster& rays() const { return *caster_; }
  uint64_t raysTraced() const { return rays_; }  // in the last frame

 private:
  bool updatePoints(const FrameInputs& in);
  void choose(const FrameInputs& in);
  LightChoiceOptions choiceOptions() const;
  std::vector<MapLight> bounded(std::span<const SceneVpl> lights) const;
  void chooseForRest();
  void renderQuick(const FrameInputs& in, bool& gbufferIsCurrent);
  void goOn(const FrameInputs& in, const Direct& direct);

  ImperfectParameters parameters_;
  bool isStarted_ = false;
  const RenderScene* scene_ = nullptr;  // of the last frame
  const RayCaster* caster_ = nullptr;
  uint64_t rays_ = 0;
  View view_;
  std::optional<View> chosenFor_;  // the view for which lights and points were chosen
  ReflectiveMap map_;
  std::vector<float> importance_;  // by texel of the map
  ViewSamples viewSamples_;
  ChosenLights chosen_;
  std::vector<MapLight> lights_;  // chosen_
  OccluderPoints points_;
  SurfacePictureOptions options_;
  bool isOutdated_ = true;  // the quick picture
  bool reflectanceIsCurrent_ = false;
  std::vector<vec3> reflectance_;  // of the pixels without a shift, over π
  Image quick_;                    // radiance by interleaved samples
  VisibleImportance visible_;      // for the exact sum
  ExactSum exact_;
  int antialias_ = 1;
  std::shared_ptr<RadianceImage> under_, shown_;
};

}  // namespace lamplighter
