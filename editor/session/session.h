// One editing session: the document and its history, the camera, the tools and the frame renderer,
// without a window. Once per frame the ui calls, in this order: runAction() and the edits of
// panels, viewport(), renderFrame(), overlay().
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "editor/debug_views/view_display.h"
#include "editor/document/document.h"
#include "editor/edits/clipboard_fragment.h"
#include "editor/edits/editing.h"
#include "editor/edits/placement.h"
#include "editor/explain/point_tools.h"
#include "editor/keys/action.h"
#include "editor/lights/work_light.h"
#include "editor/notices/notices.h"
#include "editor/probes/live_probes.h"
#include "editor/recovery/crash_recovery.h"
#include "editor/session/frame_failures.h"
#include "editor/session/frame_watch.h"
#include "editor/session/lighting_state.h"
#include "editor/split/split_view.h"
#include "editor/tools/gizmo.h"
#include "editor/tools/overlay.h"
#include "editor/tools/viewport_input.h"
#include "renderer/frame/frame.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

struct UserState;

class Session {
 public:
  explicit Session(std::unique_ptr<FrameRenderer> renderer);
  ~Session();

  // Replaces the document by a loaded scene and clears the history. The view becomes that of the
  // first camera or, without one, shows the whole scene. The status shows the loader's warnings.
  void open(Scene scene, std::filesystem::path path, const std::vector<std::string>& warnings);
  // Saves as glTF. Throws InputError, and leaves the document unchanged, if that fails, or if it
  // would overwrite a file that another program has changed, unless `forced`.
  void save(const std::filesystem::path& path, bool forced = false);
  // The files that saving to `path` would overwrite or refer to, and that another program has
  // changed since they were read or written.
  std::vector<std::filesystem::path> changedOnDisk(const std::filesystem::path& path) const;
  bool modified() const;  // since opened or saved; render settings are not saved and do not count

  // The document is changed through transactions of editing() only.
  const Document& document() const { return document_; }
  const History& history() const { return editing_.history(); }
  Editing& editing() { return editing_; }
  const Editing& editing() const { return editing_; }
  ActionRegistry& actions() { return actions_; }
  const ActionRegistry& actions() const { return actions_; }
  FrameRenderer& renderer() { return *renderer_; }

  // Runs an action given as text (ActionRegistry::parse). Throws InputError, and leaves the
  // document unchanged, for an unknown name or invalid arguments. A disabled action does nothing.
  void perform(std::string_view text);
  // The same, but shows an exception of any kind in the status line and returns false.
  bool runAction(std::string_view text);

  // Edits by panels. Each is one undo step, or joins the open transaction.
  void setNodeTransform(NodeId id, const Transform& local);
  void setAreaLight(NodeId id, const AreaLight& light);
  void setPunctualLight(NodeId id, const PunctualLight& light);
  void setMaterial(int index, const Material& material);
  void setName(NodeId id, const std::string& name);
  void setVisible(NodeId id, bool visible);
  void setMeshKind(NodeId id, MeshKind kind);
  void setSky(const Sky& sky);
  void setRender(const RenderSettings& settings);
  void select(std::vector<NodeId> ids) { editing_.select(std::move(ids)); }
  void undo();
  void redo();
  void goToStep(size_t position);  // as Editing::goTo()

  // The camera and the tools.
  const View& view() const { return view_; }
  void setView(const View& view) { view_ = view; }
  // The view fills this area or, with tiles, has the size of one.
  void resizeViewport(int width, int height);
  TileLayout tiles() const { return split_.layout(area_); }  // in the area
  ToolMode tool() const;
  void setTool(ToolMode mode);
  bool snapping() const;
  void setSnapping(bool on);
  SnapTo snapTo() const;
  void setSnapTo(SnapTo target);
  // An action that adds and selects something ("light.add disk"). The next click in the viewport
  // runs it and places the new object on the surface there. "": a click selects.
  bool placing() const { return !placing_.empty(); }
  const std::string& placed() const { return placing_; }
  void startPlacing(std::string action) { placing_ = std::move(action); }
  // Whether the gizmo or a light handle is being dragged. The drag can be committed or cancelled.
  bool dragging() const;
  void finishDrag();
  void cancelDrag();
  // Whether the right mouse button is flying the camera. Letter keys then steer.
  bool flying() const;
  float cameraSpeed() const;  // when flying [m/s]
  void frameSelection();      // the whole scene if nothing is selected
  void frameAll();
  void viewport(const ViewportInput& input);  // camera, pick, gizmo

  // Renders one frame with the latest changes. `output().settled` is true once nothing remains to
  // be done. If rendering fails, for example for lack of memory, the last picture stays, and
  // renderError() and the status give the reason. FrameFailures says when it is tried again.
  // `updates` replaces the parameter of that name: the amount of work that fits into the time of a
  // frame.
  const GiOutput& renderFrame(std::optional<int> updates = {}, const FrameBudget& budget = {});
  // Instead of renderFrame(), for a frame that is not shown: updates only the scene that tools use.
  void skipFrame();
  // Discards what the method keeps; the next frame is rendered even if the last one failed.
  void renderAnew() {
    renderer_->restart();
    failures_.tryAgain();
  }
  const std::string& renderError() const { return failures_.why(); }  // "": it was rendered
  const GiOutput& output() const { return output_; }
  // Which debug view is shown.
  ViewDisplay& display() { return display_; }
  const ViewDisplay& display() const { return display_; }
  // In the unit of renderScene(), as is everything of renderer().
  Inspection inspect() const { return renderer_->inspect(); }
  // The picture in the viewport, without the overlay. With tiles: all of them with their figures.
  Image8 picture();
  // All sides of the split view with their figures.
  Image8 sheet();
  uint32_t frame() const { return frame_; }
  const RenderScene& renderScene() const { return renderer_->scene(); }  // of the last frame
  float unit() const { return renderScene().unit; }          // of lengths that suit the level [m]
  Bounds bounds() const;                                     // of the level [m]
  uint64_t sceneRevision() const { return sceneRevision_; }  // increases with each change of it
  LightingState& lighting() { return lighting_; }
  LiveProbes& probes() { return probes_; }
  const LiveProbes& probes() const { return probes_; }
  const LightingState& lighting() const { return lighting_; }

  // The tools that inspect a clicked point, and their input.
  PointTools& points() { return points_; }
  const PointTools& points() const { return points_; }
  PointTools::Subject pointSubject() const;
  std::optional<vec2> pointer() const;  // last position over the viewport

  // Measurements of frames, and the second picture of the split view.
  FrameWatch& watch() { return watch_; }
  const FrameWatch& watch() const { return watch_; }
  SplitView& split() { return split_; }
  const SplitView& split() const { return split_; }
  // Measures the time of frames. Without a clock they are only counted.
  void setClock(Stopwatch clock) { clock_ = std::move(clock); }

  // What is drawn over the picture: gizmo, selection outline, shapes of lights.
  Overlay overlay() const;

  const std::string& status() const { return status_; }
  void setStatus(std::string text, NoticeKind kind = NoticeKind::info);
  // Settings, keys and messages, which belong to the user and not to the level.
  UserState& home() { return *home_; }
  const UserState& home() const { return *home_; }
  // The objects that edit.copy copied. They stay when another level is opened.
  const ClipboardFragment& clipboard() const { return clipboard_; }
  void setClipboard(ClipboardFragment fragment) {
    clipboard_ = std::move(fragment);
    clipboardLevel_ = level_;
  }
  bool clipboardIsOfThisLevel() const { return clipboardLevel_ == level_; }

  // Switches between the reference and the method that was shown before.
  void toggleReference();

  // After this call every committed edit is written to a journal in `root` (editor/recovery).
  void keepJournal(const std::filesystem::path& root, int process, Journal::Clock clock);
  CrashRecovery& crashRecovery() { return crashRecovery_; }
  const CrashRecovery& crashRecovery() const { return crashRecovery_; }
  void recoverWork(size_t number);  // one of crashRecovery().found(); throws InputError
  void discardWork(size_t number);
  void autosave();

  bool quitRequested() const { return quit_; }
  void requestQuit(bool quit = true) { quit_ = quit; }

  // Requests of actions to the application. Each is returned once.
  void requestOpen(std::filesystem::path path) { openRequest_ = std::move(path); }
  std::optional<std::filesystem::path> takeOpenRequest() {
    return std::exchange(openRequest_, std::nullopt);
  }
  void requestScreenshot(std::filesystem::path path) { screenshotRequest_ = std::move(path); }
  std::optional<std::filesystem::path> takeScreenshotRequest() {
    return std::exchange(screenshotRequest_, std::nullopt);
  }

  // Where an action may write a file: `wanted` itself or, in a replay, the replay's own folder.
  std::filesystem::path writablePath(const std::filesystem::path& wanted) const;

  void requestShaders() { shadersRequested_ = true; }
  bool takeShadersRequest() { return std::exchange(shadersRequested_, false); }

  // Where an object would be placed: on the surface under the pointer, or ahead of the camera.
  using Place = SurfacePoint;
  // The nearest surface under the last pointer position that is not part of `ignored`.
  std::optional<Place> surfaceUnderPointer(const std::vector<NodeId>& ignored) const;
  std::optional<Place> surfaceAhead(const std::vector<NodeId>& ignored = {}) const;  // mid-view

 private:
  struct Tools;
  Editing editing_;
  const Document& document_ = editing_.document();
  ActionRegistry actions_;
  std::unique_ptr<UserState> home_;
  std::unique_ptr<FrameRenderer> renderer_;
  std::unique_ptr<Tools> tools_;
  View view_;
  glm::ivec2 area_{1};    // of the viewport [px]
  bool isTiled_ = false;  // the view has the size of a tile
  GiOutput output_;
  ViewDisplay display_;
  PointTools points_;
  FrameWatch watch_;
  SplitView split_;
  Stopwatch clock_;
  std::string status_, placing_;
  FrameFailures failures_;
  uint32_t frame_ = 0;
  uint64_t sceneRevision_ = 0;
  SceneChanges unshown_;  // of skipped frames
  LightingState lighting_;
  LiveProbes probes_;
  WorkLight workLight_;
  uint64_t savedHash_ = 0;
  std::vector<FileStamp> disk_;  // the level's files when they were opened or saved
  bool quit_ = false, shadersRequested_ = false;
  std::string methodBeforeReference_ = "many_lights";
  ClipboardFragment clipboard_;
  CrashRecovery crashRecovery_;
  int level_ = 0, clipboardLevel_ = 0;  // number of the opened level
  std::optional<std::filesystem::path> openRequest_, screenshotRequest_;

  template <typename Change>
  void editNode(NodeId id, const std::string& verb, Change change);
  void takeWritten(const std::filesystem::path& path,
                   const std::vector<std::filesystem::path>& written, bool keepsOthers);
  std::optional<vec3> probeProp() const;
  std::optional<vec3> vertexUnderPointer(const std::vector<NodeId>& ignored) const;
  const Scene& litScene(SceneChanges& changes);
  void updateProbes(const SceneChanges& changes, bool isTimed);
  void watchFrame(const SceneChanges& changes, double begin, bool isPaced);
  Image8 firstPicture() const;
  void fitView();
  void tell(const std::exception_ptr& failure);
  void frameFailed(const std::exception& e, const FrameFailures::Input& input);
  std::optional<Place> surfaceAlong(const vec3& direction,
                                    const std::vector<NodeId>& ignored) const;
};

}  // namespace lamplighter
