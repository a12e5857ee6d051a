// The editor as a running program: input comes in, panels and tools act on the session, a picture
// goes out. It runs in a window or in nothing at all, from a hand or from a recording, by the same
// code.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "editor/session/session.h"
#include "renderer/methods/frame_time_control.h"
#include "ui/app/autosave_worker.h"
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

  // Every frame lasts this long for tools and panels; 0: as long as it did. Recordings need it
  // fixed.
  void setTimeStep(float seconds) { timeStep_ = seconds; }
  // Told of each frame's events, with their targets named.
  using Listener = std::function<void(const std::vector<InputEvent>&)>;
  void setListener(Listener listener) { listener_ = std::move(listener); }
  void setReplaying(bool replaying) { replaying_ = replaying; }
  // Time goes on by the time step with each frame, so that what is shown of it is the same each
  // time. After setTimeStep().
  void useFrameClock();
  // Frames in which nothing was edited are laid out and take input, but are not rendered or drawn.
  void skipPictures(bool skips) { skipsPictures_ = skips; }
  // Takes the user's settings and keys, and keeps what changes. Not where input is replayed or
  // recorded. `preferences` are those that were read from the files.
  void setUser(std::unique_ptr<UserFiles> files, Preferences preferences);

  // Loads on another thread; the frames go on meanwhile.
  void openInBackground(const std::filesystem::path& path) { loader_.start(path); }
  // Loads before it returns. Throws InputError.
  void openNow(const std::filesystem::path& path);
  bool loading() const { return loader_.running(); }
  // An exposure that suits the picture; no step of the history, since nobody chose it.
  void followExposure();
  void exposeAutomatically();
  void showError(const std::string& text);

  void frame();
  bool finished() const { return finished_; }
  // Nothing is left to be saved: the journal goes away.
  void close();
  // Frames since the last input.
  int quietFrames() const { return quietFrames_; }
  // Nothing will change without input.
  bool idle() const;

 private:
  double seconds() const;  // since some moment
  void takeInput();
  void handle(const InputEvent& event);
  void pressKey(Key key);
  void runAction(const std::string& text);
  void drawPanels(PanelContext ui);
  bool rendersFrame();
  void drawStatusLine(const PanelContext& ui);
  void drawDialogs(PanelContext ui);
  std::optional<int> updatesWithinTime();
  int refineUpdates();
  void present();
  void logLatency();
  void takeLoaded();
  void answerRequests();
  void openSave(const std::filesystem::path& path, bool forced = false);
  void closeIfSaved();
  void updateTitle();
  bool dialogOpen() const;
  // ui/app/application_user.cpp
  float uiScale() const;  // pixels a design pixel
  void exchangePreferences();
  void drawBottom(const PanelContext& ui);
  bool focusByKey(const std::string& action);
  void focusPanel(int step);
  void focusAsAsked();
  void flushPreferences();

  Platform& platform_;
  std::unique_ptr<Session> session_;
  WidgetMap widgets_;
  InputQueue input_;
  InputRouter router_{widgets_};
  ImGuiLayer gui_;
  Picture picture_, secondPicture_;
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
  MessageBox messageBox_;
  SaveQuestion saveQuestion_;
  OverwriteQuestion overwriteQuestion_;
  std::filesystem::path savesTo_;  // once that is answered
  ProgressBox progressBox_;
  CommandPalette palette_;
  RecoveryDialog recoveryDialog_;
  AutosaveWorker autosave_;
  SettingsState settingsState_;
  LogState logState_;
  AssetPanelState assetState_;
  Thumbnails thumbnails_;
  ToastState toastState_;
  std::unique_ptr<UserFiles> userFiles_;  // null: nothing is read or kept
  Settings appliedPreferences_;           // that the layout goes by

  // What to do once the question of unsaved changes is answered.
  enum class Pending { none, quit, open };
  Pending pending_ = Pending::none;
  std::filesystem::path pendingOpen_;

  float timeStep_ = 0.0f;
  double lastSeconds_ = 0.0;
  double frameSeconds_ = 0.0;
  FrameTimeControl frameTime_, refineTime_;
  float dt_ = 1.0f / 60.0f;
  bool frameClock_ = false;
  uint64_t frames_ = 0;
  bool skipsPictures_ = false;
  size_t renderedPosition_ = ~size_t{0};  // of the history, when a frame was rendered last
  bool replaying_ = false;
  bool finished_ = false;
  int framesToExposure_ = 0;
  std::optional<float> lastExposure_;  // [EV], of a level whose light is still to come
  size_t latenciesLogged_ = 0;
  int quietFrames_ = 0;
  std::optional<int> focusStep_;       // to another panel; 0: to the menus
  size_t titlePosition_ = ~size_t{0};  // of the history, when the title was made
  std::string title_;
};

}  // namespace lamplighter
