// A whole frame, from the scene to the picture.
#pragma once

#include <filesystem>
#include <memory>

#include "renderer/methods/gi_method.h"
#include "renderer/scene/scene_changes.h"

namespace lamplighter {

// Everything kept from one frame to the next for one scene on one backend.
class FrameRenderer {
 public:
  explicit FrameRenderer(std::unique_ptr<Backend> backend, Stopwatch stopwatch = {});
  ~FrameRenderer();

  struct Request {
    const Scene& scene;
    const SceneChanges& changes;  // since the last request; all() the first time
    const View& view;
    const std::string& method;
    const Settings& settings;
    bool lightOnly = false;     // what is seen is shown as if it were white
    bool inBackground = false;  // FrameInputs
    // Light samples by which a settled picture may be refined in this frame; 0: it stays as it is.
    int refineUpdates = 0;
    LightPart part = LightPart::all;
  };
  // One frame. Throws InputError for an unknown method.
  GiOutput render(const Request& request);

  // Brings scene() and rays() up to date without a picture; the next render() goes on from there,
  // with what changed after this.
  void update(const Scene& scene, const SceneChanges& changes);

  // What the method keeps, for views of it; good until the next call of the others.
  Inspection inspect() const { return method_ ? method_->inspect() : Inspection(); }

  // Where what takes seconds to prepare is kept from run to run; made when needed. Empty, as at
  // first: nowhere.
  void setCacheFolder(std::filesystem::path folder) { cacheFolder_ = std::move(folder); }

  // Forgets what the method keeps: the next picture is made from nothing.
  void restart();

  Backend& backend() { return *backend_; }
  const RenderScene& scene() const { return scene_; }
  const RayCaster* rays() const { return rays_.get(); }  // null before the first frame

 private:
  std::unique_ptr<Backend> backend_;
  Stopwatch stopwatch_;
  RenderScene scene_;
  std::unique_ptr<RayCaster> rays_;
  RenderSceneChanges pending_;  // that the backend and the method have not seen yet
  bool hasOtherScene_ = false;  // another scene altogether, likewise
  std::string methodName_;
  std::unique_ptr<GiMethod> method_;
  uint32_t frame_ = 0;
  std::filesystem::path cacheFolder_;
};

}  // namespace lamplighter
