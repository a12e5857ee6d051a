#include <algorithm>
#include <filesystem>
#include <iostream>
#include <optional>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "editor/cli/options.h"
#include "editor/document/write_file.h"
#include "editor/input/player.h"
#include "editor/latency/latency_report.h"
#include "editor/notices/failure_text.h"
#include "editor/session/user_state.h"
#include "renderer/base/error.h"
#include "renderer/base/threads.h"
#include "renderer/gl/headless_context.h"
#include "renderer/image/image_io.h"
#include "renderer/registry/registry.h"
#include "ui/app/application.h"
#include "ui/app/backends.h"
#include "ui/app/replay_checks.h"
#include "ui/app/run.h"
#include "ui/platform/headless.h"
#include "ui/platform/ui_scale.h"
#include "ui/platform/window.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

// The maximum number of frames until a checkpoint settles. After it the recording counts as broken.
constexpr int kPatience = 5000;
// Frames without input before a checkpoint: some widgets react one frame after the input.
constexpr int kQuietFrames = 2;

// The folder where actions of a recording save files: the requested folder, or a temporary folder
// that is deleted.
class WriteFolder {
 public:
  explicit WriteFolder(const fs::path& asked) : path_(asked), isOurs_(asked.empty()) {
    if (!isOurs_) return;
    std::string name = (fs::temp_directory_path() / "lamplighter-replay-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw InputError(name, "cannot be created", "check the folder and the space left");
    path_ = name;
  }
  ~WriteFolder() {
    std::error_code ignored;
    if (isOurs_) fs::remove_all(path_, ignored);
  }
  WriteFolder(const WriteFolder&) = delete;
  WriteFolder& operator=(const WriteFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
  bool isOurs_;
};

class Replay {
 public:
  Replay(const ReplayOptions& options, const Recording& recording, ReplayChecks& checks)
      : options_(options),
        checks_(checks),
        updated_(recording),
        player_(recording, kPatience),
        writeFolder_(options_.outputFolder) {}

  using MakeRenderer = SplitView::MakeRenderer;
  // `reports`: writes edit latencies to the screen and to the report.
  void run(Platform& platform, const MakeRenderer& makeRenderer, bool reports);

 private:
  const RecordingHeader& header() const { return player_.recording().header; }
  void start(Application& app);
  void keepJournal(Session& session);
  void check(Application& app, Platform& platform, const Checkpoint& checkpoint);
  std::string hashOf(const Session& session) const;
  void writePictures(Platform& platform, const Image8& picture, const Checkpoint& checkpoint) const;
  void writeReport(Session& session) const;

  const ReplayOptions& options_;
  ReplayChecks& checks_;
  Recording updated_;  // the recording with the hashes of this run
  Player player_;
  WriteFolder writeFolder_;
  // copies of the journals that the recording provides, if any
  std::optional<WriteFolder> journals_;
};

void Replay::start(Application& app) {
  app.setReplaying(true);
  app.setTimeStep(1.0f / static_cast<float>(std::max(header().framesPerSecond, 1)));
  if (options_.frameClock) app.useFrameClock();
  Session& session = app.session();
  session.home().writeFolder = writeFolder_.path();
  RenderSettings render = header().render;
  if (!options_.method.empty()) render.method = options_.method;
  for (const std::string& a : options_.assignments)
    cli::setFromAssignment(render.values, findMethod(render.method), a);
  session.editing().setInitialRender(std::move(render));
  keepJournal(session);
  for (int i = 0; i < 2; ++i) app.frame();  // these frames compute the sizes of the layout
  const fs::path scene = player_.recording().scenePath();
  if (scene.empty()) return;
  const std::string hash = hashText(fileHash(scene));
  if (options_.updateBaselines)
    updated_.header.sceneHash = hash;
  else if (!header().sceneHash.empty() && header().sceneHash != hash)
    throw InputError(options_.recording,
                     "the scene " + scene.string() + " is not the one that was recorded",
                     "replay with --update-baselines if it was changed on purpose");
  app.openNow(scene);
}

void Replay::keepJournal(Session& session) {
  const fs::path left = player_.recording().leftPath();
  if (left.empty()) return;
  journals_.emplace(fs::path());
  std::error_code error;
  fs::copy(left, journals_->path(), fs::copy_options::recursive, error);
  if (error)
    throw InputError(left.string(), "cannot be copied: " + error.message(),
                     "restore the folder, or remove \"left\" from the recording");
  session.keepJournal(journals_->path(), ::getpid(), [] { return int64_t{0}; });
}

void Replay::run(Platform& platform, const MakeRenderer& makeRenderer, bool reports) {
  Application app(platform, std::make_unique<Session>(makeRenderer()));
  app.session().split().setRenderer(makeRenderer);
  start(app);
  while (!player_.finished() && !app.finished()) {
    std::vector<InputEvent> ignored;
    platform.poll(ignored, 0.0);
    for (InputEvent& event : player_.beginFrame()) app.input().push(std::move(event));
    // Only frames at checkpoints must be rendered.
    app.skipPictures(options_.frameClock && !player_.waits());
    try {
      app.frame();
    } catch (const std::exception& e) {
      throw InputError(options_.recording + ": frame " + std::to_string(player_.frame()) + ": " +
                       failureText(e));
    }
    if (!app.session().renderError().empty()) throw InputError(app.session().renderError());
    const bool settled = app.session().output().settled && app.session().probes().settled() &&
                         app.quietFrames() >= kQuietFrames;
    for (const Checkpoint& checkpoint : player_.endFrame(settled)) check(app, platform, checkpoint);
  }
  if (options_.updateBaselines) writeRecording(updated_);
  if (!reports) return;
  const std::string latency = latencySummary(app.session().watch().latency);
  if (!latency.empty()) std::cout << latency << '\n';
  if (!options_.report.empty()) writeReport(app.session());
}

void Replay::writeReport(Session& session) const {
  const BackendInfo& backend = session.renderer().backend().info();
  const nlohmann::ordered_json report{{"recording", options_.recording},
                                      {"backend", backend.name},
                                      {"device", backend.device},
                                      {"frames", session.frame()},
                                      {"checks", checks_.report()},
                                      {"actions", session.home().ran},
                                      {"edits", latencyJson(session.watch().latency)}};
  writeFile(options_.report, report.dump(2) + '\n');
}

std::string Replay::hashOf(const Session& session) const {
  Document document = session.document();
  // The method from the command line is not an edit of the recording.
  if (!options_.method.empty() && document.render.method == options_.method)
    document.render.method = header().render.method;
  // Nor are values.
  for (const std::string& a : options_.assignments)
    document.render.values.reset(a.substr(0, a.find('=')));
  return hashText(documentHash(document));
}

void Replay::writePictures(Platform& platform, const Image8& picture,
                           const Checkpoint& checkpoint) const {
  if (options_.outputFolder.empty()) return;
  fs::create_directories(options_.outputFolder);
  writePng(picture, checks_.outputOf(checkpoint, ".png"));
  if (platform.hasGl())
    writePng(platform.screenshot(), checks_.outputOf(checkpoint, ".window.png"));
}

void Replay::check(Application& app, Platform& platform, const Checkpoint& checkpoint) {
  const std::string document = hashOf(app.session());
  Image8 picture = app.session().picture();
  writePictures(platform, picture, checkpoint);
  if (options_.updateBaselines) {
    for (RecordingLine& line : updated_.lines)
      if (auto* c = std::get_if<Checkpoint>(&line.what); c && c->name == checkpoint.name)
        c->document = document;
    checks_.writeBaseline(checkpoint, picture);
    std::cout << checkpoint.name << ": written" << std::endl;
  } else if (options_.check) {
    checks_.take(checkpoint, document, std::move(picture));
  } else {
    std::cout << checkpoint.name << ": document " << document << std::endl;
  }
}

}  // namespace

int runReplay(const ReplayOptions& options, const Stopwatch& stopwatch) {
  const Recording recording = readRecording(options.recording);
  const RecordingHeader& header = recording.header;
  // The cpu backend gives the same bits everywhere, so it is the default for replays.
  const std::string backend = options.backend == "auto" ? "cpu" : options.backend;
  const bool needsGl = backend == "gl" ||
                       std::count(options.against.begin(), options.against.end(), "backend=gl") > 0;
  const std::optional<float> scale = askedUiScale();
  std::unique_ptr<Platform> platform;
  // Only the gl backend and screenshots of the panels need OpenGL.
  std::unique_ptr<gl::HeadlessContext> context;
  if (options.headless) {
    try {
      if (needsGl || !options.outputFolder.empty())
        context = std::make_unique<gl::HeadlessContext>();
    } catch (const InputError&) {
      if (needsGl) throw;
    }
    platform = std::make_unique<Headless>(header.width, header.height, context != nullptr,
                                          scale.value_or(1.0f));
  } else {
    platform = std::make_unique<Window>(header.width, header.height, "Lamplighter: replay",
                                        Window::Kind::fixed, scale);
  }

  ReplayChecks checks(options, recording);
  const auto play = [&](const ReplayRun& run, const std::string& onBackend, int threads) {
    const ThreadLimit limit(threads);
    // Without a stopwatch the stages of a frame are not timed.
    const auto renderer = [&] {
      return std::make_unique<FrameRenderer>(makeBackend(onBackend, stopwatch),
                                             options.frameClock ? Stopwatch() : stopwatch);
    };
    checks.begin(run);
    Replay(options, recording, checks).run(*platform, renderer, run.label.empty());
  };
  play({"", true, backend == "cpu"}, backend, options.threads);
  for (const std::string& way : options.against) {
    const std::string value = way.substr(way.find('=') + 1);
    const bool isBackend = way.starts_with("backend=");
    const std::string& other = isBackend ? value : backend;
    play({way, other == backend, other == "cpu"}, other,
         isBackend ? options.threads : std::stoi(value));
  }
  if (options.check)
    std::cout << checks.passed() << " checks passed, " << checks.failed() << " failed\n";
  return checks.failed() == 0 ? 0 : 1;
}

}  // namespace lamplighter
