#include <algorithm>
#include <filesystem>
#include <optional>

#include "editor/document/cache_folder.h"
#include "editor/input/recorder.h"
#include "renderer/base/data_folder.h"
#include "renderer/base/error.h"
#include "ui/app/application.h"
#include "ui/app/backends.h"
#include "ui/app/run.h"
#include "ui/panels/panels.h"
#include "ui/platform/ui_scale.h"
#include "ui/platform/window.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

constexpr int kRecordedWidth = 1280, kRecordedHeight = 720;
constexpr int kFramesPerSecond = 60;  // of recordings

// Shown while OpenGL compiles shaders, the only long work that must run on this thread.
void showPreparing(Window& window, float scale) {
  ImGuiLayer gui(window);
  WidgetMap widgets;
  for (int i = 0; i < 2; ++i) {  // the first frame only computes sizes
    std::vector<InputEvent> ignored;
    window.poll(ignored, 0.0);
    gui.beginFrame({}, 1.0f / 60.0f, scale);
    centredNotice(scale, "Preparing shaders\u2026");
    gui.endFrame();
    window.present();
  }
}

fs::path defaultScene() { return dataFolder() / "assets" / "scenes" / "default.gltf"; }

RecordingHeader headerFor(const fs::path& scene, const fs::path& recording,
                          const RenderSettings& render) {
  RecordingHeader header;
  std::error_code ignored;
  const fs::path folder = fs::absolute(recording, ignored).parent_path();
  const fs::path relative = fs::relative(fs::absolute(scene, ignored), folder, ignored);
  header.scene = (relative.empty() ? fs::absolute(scene, ignored) : relative).generic_string();
  header.sceneHash = hashText(fileHash(scene));
  header.width = kRecordedWidth;
  header.height = kRecordedHeight;
  header.framesPerSecond = kFramesPerSecond;
  header.render = render;
  return header;
}

void pump(Platform& platform, Application& app) {
  std::vector<InputEvent> events;
  // An idle program uses almost no CPU; it wakes up regularly for blinking cursors.
  platform.poll(events, app.idle() ? 0.2 : 0.0);
  for (InputEvent& event : events) app.input().push(std::move(event));
}

}  // namespace

int runEditor(const EditorOptions& options, const Frontend& frontend) {
  const Stopwatch& stopwatch = frontend.stopwatch;
  const fs::path scene = options.scene.empty() ? defaultScene() : fs::path(options.scene);
  const bool recording = !options.record.empty();
  // A recording must have the same effect in another window. So its window has a fixed size and
  // scale, and does not use the user's settings.
  auto files = std::make_unique<UserFiles>(recording ? fs::path() : configFolder());
  Preferences preferences = files->readPreferences();
  const UserSettings settings = preferences.settings();
  Window window(settings.windowWidth, settings.windowHeight, "Lamplighter",
                recording ? Window::Kind::fixed : Window::Kind::resizable,
                recording ? std::nullopt : askedUiScale());
  showPreparing(window,
                std::clamp(window.contentScale() * settings.uiScale, kLeastUiScale, kMostUiScale));
  const auto makeRenderer = [&] {
    auto made = std::make_unique<FrameRenderer>(makeBackend(options.backend, stopwatch), stopwatch);
    // Recordings must not depend on files of earlier sessions.
    if (!recording) made->setCacheFolder(transferFolder());
    return made;
  };
  Application app(window, std::make_unique<Session>(makeRenderer()));
  app.session().split().setRenderer(makeRenderer);
  if (!recording) app.setUser(std::move(files), std::move(preferences));
  const fs::path journal = options.journal.empty() ? recoveryFolder() : fs::path(options.journal);
  // Recoverable work must not affect a recording either.
  if (!recording && !journal.empty())
    app.session().keepJournal(journal, frontend.process, frontend.unixTime);
  std::optional<Recorder> recorder;
  // Recordings must not depend on the timing of a thread; they measure by an action.
  app.session().watch().meter.setOn(!recording);
  if (!recording) {
    app.openInBackground(scene);
  } else {
    app.setTimeStep(1.0f / kFramesPerSecond);
    for (int i = 0; i < 2; ++i) app.frame();  // these frames compute the sizes of the layout
    app.openNow(scene);
    app.frame();
    app.exposeAutomatically();
    recorder.emplace(options.record,
                     headerFor(scene, options.record, app.session().document().render));
    app.setListener([&](const std::vector<InputEvent>& events) {
      if (!recorder) return;
      try {
        recorder->frame(events);
      } catch (const InputError& e) {
        recorder.reset();
        app.showError(e.what());
      }
    });
  }
  while (!app.finished()) {
    pump(window, app);
    app.frame();
  }
  app.close();
  return 0;
}

}  // namespace lamplighter
