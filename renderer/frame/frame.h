// Renders a whole frame, from the scene to the picture.
#pragma once

#include <filesystem>
#include <memory>

#include "renderer/frame/world.h"
#include "renderer/methods/gi_method.h"
#include "renderer/scene/scene_changes.h"

namespace lamplighter {

// All state that is kept between frames, for one scene on one backend.
class FrameRenderer {
 public:
  // stageTimes: if there is a stopwatch.
  explicit FrameRenderer(std::unique_ptr<Backend> backend, Stopwatch stopwatch = {},
                         StageTimes stageTimes = StageTimes::late);
  ~FrameRenderer();

  struct Request {
    const Scene& scene;
    const SceneChanges& changes;  // since the last request; all() in the first one
    const View& view;             // [m]
    const std::string& method;
    const Settings& settings;
    bool lightOnly = false;  // visible surfaces are shown white
    FrameBudget budget = {};
    LightPart part = LightPart::all;
  };
  // Renders one frame. Throws InputError for an unknown method, and what the method, Embree and the
  // device throw. After an exception all possibly inconsistent data is discarded; the next call
  // computes it again.
  GiOutput render(const Request& request);

  // Updates scene() and rays() without a picture. The next render() continues from there, with the
  // changes that follow.
  void update(const Scene& scene, const SceneChanges& changes);

  // Internal data of the method, for debug views, in the unit of scene(). Valid until the next call
  // of another function.
  Inspection inspect() const { return method_ ? method_->inspect() : Inspection(); }

  // As in Services.
  void setCacheFolder(std::filesystem::path folder) { services_.setCacheFolder(std::move(folder)); }

  // Discards what the method keeps: the next picture is computed from scratch.
  void restart();
  // Continues on another backend, from scratch.
  void setBackend(std::unique_ptr<Backend> backend);

  Backend& backend() { return *backend_; }
  // Both are in the unit of the scene (RenderScene::unit).
  const RenderScene& scene() const { return world_.scene(); }
  const RayCaster* rays() const { return world_.rays(); }  // null before the first frame
  const World& world() const { return world_; }
  Services& services() { return services_; }

 private:
  GiOutput renderUpdated(const Request& request);
  void forget();

  std::unique_ptr<Backend> backend_;
  Stopwatch stopwatch_;
  StageTimes stageTimes_;
  World world_;
  RenderSceneChanges pending_;  // changes that the backend and the method have not received yet
  bool hasOtherScene_ = false;  // the scene was replaced, which they have not received yet
  std::string methodName_;
  std::unique_ptr<GiMethod> method_;
  uint32_t frame_ = 0;
  Services services_;
};

}  // namespace lamplighter
