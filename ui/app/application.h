// The running editor: it takes input, lets panels and tools act on the session, and shows a
// picture. The same code runs in a window or headless, from a user or from a recording.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "editor/session/frame_pacer.h"
#include "editor/session/session.h"
#include "ui/app/autosave_worker.h"
#include "ui/app/frame_parts.h"
#include "ui/app/imgui_layer.h"
#include "ui/app/input_queue.h"
#include "ui/app/layout.h"
#include "ui/app/meter_worker.h"
#include "ui/app/scene_loader.h"
#include "ui/app/user_files.h"
#include "ui/panels/asset_panel.h"
#include "ui/panels/command_palette.h"
#include "ui/panels/dialogs/file_dialog.h"
#include "ui/panels/dialogs/recovery_dialog.h"
#include "ui/panels/light_table/light_table_panel.h"
#include "ui/panels/panels.h"
#include "ui/panels/user_panels.h"
#include "ui/platform/platform.h"
#include "ui/viewport/picture.h"
#include "ui/viewport/viewport.h"
#include "ui/widgets/input_router.h"
#include "ui/widgets/thumbnails.h"
#include "ui/widgets/widget_map.h"

namespace lamplighter {

class Application {
 public:
  Application(Platform& platform, std::unique_ptr<Session> session);
  ~Application();

  Session& session() { return *session_; }
  InputQueue& input() { return input_; }
  const WidgetMap& widgets() const { return widgets_; }

  // The duration of every frame for tools and panels; 0: the real duration. Recordings need a fixed
  // time step.
  void setTimeStep(float seconds) { timeStep_ = seconds; }
  // Receives the events of each frame, with named targets.
  using Listener = std::function<void(const std::vector<InputEvent>&)>;
  void setListener(Listener listener) { listener_ = std::move(listener); }
  void setReplaying(bool replaying) {
    replaying_ = replaying;
    parts_.setStrict(replaying);
  }
  // Advances the clock by the time step in each frame, so that displayed times are the same in
  // every run. Call after setTimeStep().
  void useFrameClock();
  // If true, frames without an edit take input and do the layout, but are not rendered or drawn.
  void skipPictures(bool skips) { skipsPictures_ = skips; }
  // Uses the user's settings and keys, and saves changes. Not called for replays and recordings.
  // `preferences` were read from the files.
  void setUser(std::unique_ptr<UserFiles> files, Preferences preferences);

  // Loads on another thread while frames continue.
  void openInBackground(const std::filesystem::path& path) { loader_.start(path); }
  // Loads before it returns. Throws InputError.
  void openNow(const std::filesystem::path& path);
  bool loading() const { return loader_.running(); }
  // Sets an exposure that suits the picture. It is not an undo step, because the user did not
  // choose it.
  void followExposure();
  void exposeAutomatically();
  void showError(const std::string& text);

  // One frame. An exception becomes a message, except in a replay; it does not end the editor.
  void frame();
  bool finished() const { return finished_; }
  // Call when there is nothing left to save. Deletes the journal.
  void close();
  // Number of frames since the last input.
  int quietFrames() const { return quietFrames_; }
  // True if nothing will change without input.
  bool idle() const;

 private:
  double seconds() const;  // since an arbitrary start
  void takeInput();
  void handle(const InputEvent& event);
  void pressKey(Key key);
  void runAction(const std::string& text);
  void inPart(const std::string& name, const std::function<void()>& work) {
    parts_.run(*session_, name, work);
  }
  void drawPanels(PanelContext ui);
  void drawFloatingPanels(const PanelContext& ui);
  void exchangeWithMeter();
  void renderAndPresent();
  bool rendersFrame();
  void drawStatusLine(const PanelContext& ui);
  void drawDialogs(PanelContext ui);
  void present();
  void presentOthers();
  void logLatency();
  void takeLoaded();
  void answerRequests();
  void ask(const Action& action);
  bool asksToOverwrite(const std::string& text, const std::filesystem::path& file);
  void closeIfSaved();
  void updateTitle();
  bool dialogOpen() const;
  // ui/app/application_user.cpp
  float uiScale() const;  // pixels per design pixel
  void exchangePreferences();
  void drawBottom(const PanelContext& ui);
  void focusPanel(int step);
  void focusAsAsked();
  void flushPreferences();

  Platform& platform_;
  std::unique_ptr<Session> session_;
  WidgetMap widgets_;
  InputQueue input_;
  InputRouter router_{widgets_};
  FrameParts parts_;
  ImGuiLayer gui_;
  Picture picture_;
  std::vector<std::unique_ptr<Picture>> otherPictures_;  // of the split view
  MeterWorker meterWorker_;
  Viewport viewport_;
  Layout layout_;
  SceneLoader loader_;
  Listener listener_;

  OutlinerState outlinerState_;
  InspectorState inspectorState_;
  LightTableState lightTableState_;
  TimelineState timelineState_;
  Requests requests_;
  FileDialog fileDialog_;
  NameDialog nameDialog_;
  MessageBox messageBox_;
  SaveQuestion saveQuestion_;
  OverwriteQuestion overwriteQuestion_;
  std::string overwriting_;  // the action that runs if the overwrite question is confirmed
  ProgressBox progressBox_;
  CommandPalette palette_;
  RecoveryDialog recoveryDialog_;
  AutosaveWorker autosave_;
  SettingsState settingsState_;
  LogState logState_;
  AssetPanelState assetState_;
  Thumbnails thumbnails_;
  ToastState toastState_;
  std::unique_ptr<UserFiles> userFiles_;  // null: no files are read or written
  Settings appliedPreferences_;           // the values that the layout uses now

  // The next step after the question about unsaved changes is answered.
  enum class Pending { none, quit, open };
  Pending pending_ = Pending::none;
  std::filesystem::path pendingOpen_;

  float timeStep_ = 0.0f;
  double lastSeconds_ = 0.0;
  double frameSeconds_ = 0.0;
  FramePacer pacer_;
  float dt_ = 1.0f / 60.0f;
  bool frameClock_ = false;
  uint64_t frames_ = 0;
  bool skipsPictures_ = false;
  size_t renderedPosition_ = ~size_t{0};  // position of the history at the last rendered frame
  bool replaying_ = false;
  bool finished_ = false;
  int framesToExposure_ = 0;
  std::optional<float> lastExposure_;  // [EV]; of a level whose lighting is not rendered yet
  size_t latenciesLogged_ = 0;
  int quietFrames_ = 0;
  size_t titlePosition_ = ~size_t{0};  // position of the history when the title was set
  std::string title_;
};

}  // namespace lamplighter
