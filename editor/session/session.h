// One editing session: the document, its history, the camera, the tools and the frame renderer; all
// that the ui shows and drives, without a window. The ui calls, once a frame and in this order:
// runAction()/edits from panels, viewport(), renderFrame(), overlay().
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
#include "editor/recovery/crash_recovery.h"
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

  // Replaces the document by a loaded scene (an empty history; the view of its first camera, or one
  // that shows it all). The status says what the loader warned of.
  void open(Scene scene, std::filesystem::path path, const std::vector<std::string>& warnings);
  // Saves as glTF; throws InputError with the document untouched when that fails, and when it would
  // overwrite what others have changed since it was opened or saved, unless that is `forced`.
  void save(const std::filesystem::path& path, bool forced = false);
  // The files that others have changed, of those that saving there would overwrite or refer to.
  std::vector<std::filesystem::path> changedOnDisk(const std::filesystem::path& path) const;
  bool modified() const;  // since opened or saved; render settings are not saved and do not count

  // The document is changed through transactions of editing() only.
  const Document& document() const { return document_; }
  const History& history() const { return editing_.history(); }
  Editing& editing() { return editing_; }
  const Editing& editing() const { return editing_; }
  const ActionRegistry& actions() const { return actions_; }
  FrameRenderer& renderer() { return *renderer_; }

  // Runs an action given as text (ActionRegistry::parse). Throws InputError for a name or arguments
  // that do not fit, with the document untouched. A disabled action does nothing.
  void perform(std::string_view text);
  // The same, but a failure goes to the status line and is returned as false.
  bool runAction(std::string_view text);

  // Edits that panels make. Each is an undoable step, or joins the open transaction.
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
  void goToStep(size_t position);  // undoes or redoes until so many are done; throws InputError

  // The camera and the tools.
  const View& view() const { return view_; }
  void setView(const View& view) { view_ = view; }
  void resizeViewport(int width, int height);
  ToolMode tool() const;
  void setTool(ToolMode mode);
  bool snapping() const;
  void setSnapping(bool on);
  SnapTo snapTo() const;
  void setSnapTo(SnapTo target);
  // What the next click in the viewport adds and puts on the surface there: an action that adds and
  // selects something ("light.add disk"). "": a click selects, as ever.
  bool placing() const { return !placing_.empty(); }
  const std::string& placed() const { return placing_; }
  void startPlacing(std::string action) { placing_ = std::move(action); }
  // A drag of the gizmo is under way. It can be ended as a step, or taken back.
  bool dragging() const;
  void finishDrag();
  void cancelDrag();
  // The right mouse button flies: letters steer then and are no shortcuts.
  bool flying() const;
  float cameraSpeed() const;  // of flight [m/s]
  void frameSelection();      // everything when nothing is selected
  void frameAll();
  void viewport(const ViewportInput& input);  // camera, pick, gizmo

  // Renders one frame of what changed and keeps it. `output().settled` says when it is done. When
  // it cannot be rendered (no memory for that many maps, say) the last picture stays, renderError()
  // and the status say why, and nothing of the work is lost.
  // `updates` stands in for the setting of that name: what fits into the time of a frame. Frames by
  // time do not wait for what is prepared in the background; all others do. By `refineUpdates`
  // light samples a picture at rest may be refined; 0: it stays as it is.
  const GiOutput& renderFrame(std::optional<int> updates = {}, int refineUpdates = 0);
  // Instead of renderFrame(), for a frame that nobody looks at: what tools look up is up to date.
  void skipFrame();
  const std::string& renderError() const { return renderError_; }  // "": it was rendered
  const GiOutput& output() const { return output_; }
  // Which view of the frame is shown.
  ViewDisplay& display() { return display_; }
  const ViewDisplay& display() const { return display_; }
  Inspection inspect() const { return renderer_->inspect(); }
  // What the viewport shows, without what is drawn over it.
  Image8 picture() const;
  uint32_t frame() const { return frame_; }
  const RenderScene& renderScene() const { return renderer_->scene(); }  // of the last frame
  uint64_t sceneRevision() const { return sceneRevision_; }  // another after each change of it
  LightingState& lighting() { return lighting_; }
  const LightingState& lighting() const { return lighting_; }

  // What tells of a clicked point, and what it looks at.
  PointTools& points() { return points_; }
  const PointTools& points() const { return points_; }
  PointTools::Subject pointSubject() const;
  std::optional<vec2> pointer() const;  // where it was last over the viewport

  // What frames cost and how soon and how well they show edits; another picture beside the first.
  FrameWatch& watch() { return watch_; }
  const FrameWatch& watch() const { return watch_; }
  SplitView& split() { return split_; }
  const SplitView& split() const { return split_; }
  // By which frames are timed; without one they are counted only.
  void setClock(Stopwatch clock) { clock_ = std::move(clock); }

  // What tools draw over the picture: gizmo, selection outline, lights' shapes.
  Overlay overlay() const;

  const std::string& status() const { return status_; }
  void setStatus(std::string text, NoticeKind kind = NoticeKind::info);
  // Settings, keys, notices: what is the user's and not the level's.
  UserState& home() { return *home_; }
  const UserState& home() const { return *home_; }
  void setKeys(KeyMap keys) { actions_.setKeys(std::move(keys)); }
  // What edit.copy has put by; opening another level leaves it.
  const ClipboardFragment& clipboard() const { return clipboard_; }
  void setClipboard(ClipboardFragment fragment) {
    clipboard_ = std::move(fragment);
    clipboardLevel_ = level_;
  }
  bool clipboardIsOfThisLevel() const { return clipboardLevel_ == level_; }

  // The reference, and from it back to the method that was shown before.
  void toggleReference();

  // Every committed edit is kept on the disk in `root` from now on (editor/recovery).
  void keepJournal(const std::filesystem::path& root, int process, Journal::Clock clock);
  CrashRecovery& crashRecovery() { return crashRecovery_; }
  const CrashRecovery& crashRecovery() const { return crashRecovery_; }
  void recoverWork(size_t number);  // one of crashRecovery().found(); throws InputError
  void discardWork(size_t number);
  void autosave();

  bool quitRequested() const { return quit_; }
  void requestQuit(bool quit = true) { quit_ = quit; }

  // What actions ask of the application, handed out once.
  void requestOpen(std::filesystem::path path) { openRequest_ = std::move(path); }
  std::optional<std::filesystem::path> takeOpenRequest() {
    return std::exchange(openRequest_, std::nullopt);
  }
  void requestScreenshot(std::filesystem::path path) { screenshotRequest_ = std::move(path); }
  std::optional<std::filesystem::path> takeScreenshotRequest() {
    return std::exchange(screenshotRequest_, std::nullopt);
  }

  // Where an action may write a file: there, or where input is replayed in a folder of the
  // replay's.
  std::filesystem::path writablePath(const std::filesystem::path& wanted) const;

  void requestShaders() { shadersRequested_ = true; }
  bool takeShadersRequest() { return std::exchange(shadersRequested_, false); }

  // Where a thing would be put: the surface under the pointer, or ahead of the camera.
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
  GiOutput output_;
  ViewDisplay display_;
  PointTools points_;
  FrameWatch watch_;
  SplitView split_;
  Stopwatch clock_;
  std::string status_, renderError_, placing_;
  uint32_t frame_ = 0;
  uint64_t sceneRevision_ = 0;
  SceneChanges unshown_;  // of frames that were skipped
  LightingState lighting_;
  WorkLight workLight_;
  uint64_t savedHash_ = 0;
  std::vector<FileStamp> disk_;  // the level's files as opened or saved
  bool quit_ = false, shadersRequested_ = false;
  std::string methodBeforeReference_ = "many_lights";
  ClipboardFragment clipboard_;
  CrashRecovery crashRecovery_;
  int level_ = 0, clipboardLevel_ = 0;  // counts what was opened
  std::optional<std::filesystem::path> openRequest_, screenshotRequest_;

  template <typename Change>
  void editNode(NodeId id, const std::string& verb, Change change);
  void takeWritten(const std::filesystem::path& path,
                   const std::vector<std::filesystem::path>& written, bool keepsOthers);
  std::optional<vec3> vertexUnderPointer(const std::vector<NodeId>& ignored) const;
  const Scene& litScene(SceneChanges& changes);
  void watchFrame(const SceneChanges& changes, double begin);
  std::optional<Place> surfaceAlong(const vec3& direction,
                                    const std::vector<NodeId>& ignored) const;
};

}  // namespace lamplighter
