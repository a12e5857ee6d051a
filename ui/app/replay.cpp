#include <filesystem>
#include <iostream>
#include <optional>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "editor/document/write_file.h"
#include "editor/input/player.h"
#include "editor/latency/latency_report.h"
#include "editor/session/home_state.h"
#include "renderer/base/error.h"
#include "renderer/base/threads.h"
#include "renderer/gl/headless_context.h"
#include "renderer/image/image_io.h"
#include "ui/app/application.h"
#include "ui/app/backends.h"
#include "ui/app/picture_check.h"
#include "ui/app/run.h"
#include "ui/platform/headless.h"
#include "ui/platform/ui_scale.h"
#include "ui/platform/window.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

// Frames that a checkpoint may take to settle before the recording counts as broken.
constexpr int kPatience = 5000;
// Frames without input before a checkpoint counts: some widgets act a frame after the input.
constexpr int kQuietFrames = 2;

// Where actions of a recording save: in the folder that is asked for, or else where it is gone
// after.
class WriteFolder {
 public:
  explicit WriteFolder(const fs::path& asked) : path_(asked), isOurs_(asked.empty()) {
    if (!isOurs_) return;
    std::string name = (fs::temp_directory_path() / "lamplighter-replay-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
      throw InputError(name, "cannot be made", "check the folder and the space left");
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
  Replay(const ReplayOptions& options, Recording recording)
      : options_(options),
        updated_(recording),
        player_(std::move(recording), kPatience),
        writeFolder_(options.outputFolder) {}

  using MakeRenderer = SplitView::MakeRenderer;
  int run(Platform& platform, const MakeRenderer& makeRenderer);

 private:
  const RecordingHeader& header() const { return player_.recording().header; }
  void start(Application& app);
  void keepJournal(Session& session);
  void check(Application& app, Platform& platform, const Checkpoint& checkpoint);
  std::string documentProblem(const Session& session, const Checkpoint& checkpoint);
  std::string pictureProblem(Session& session, const Image8& picture, const Checkpoint& checkpoint);
  void writePictures(Platform& platform, const Image8& picture, const Checkpoint& checkpoint);
  fs::path outputOf(const Checkpoint& checkpoint, const char* ending) const;
  void writeReport(Session& session) const;

  const ReplayOptions& options_;
  Recording updated_;  // with the hashes of this run
  Player player_;
  WriteFolder writeFolder_;
  std::optional<WriteFolder> journals_;  // with what others have left, where the recording has some
  int passed_ = 0, failed_ = 0;
  nlohmann::ordered_json checks_ = nlohmann::ordered_json::array();
};

void Replay::start(Application& app) {
  app.setReplaying(true);
  app.setTimeStep(1.0f / static_cast<float>(std::max(header().framesPerSecond, 1)));
  if (options_.frameClock) app.useFrameClock();
  Session& session = app.session();
  session.home().writeFolder = writeFolder_.path();
  session.document().render = header().render;
  if (!options_.method.empty()) session.document().render.method = options_.method;
  keepJournal(session);
  for (int i = 0; i < 2; ++i) app.frame();  // the layout's sizes are known after these
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
                     "put there what the recording finds, or take \"left\" out of it");
  session.keepJournal(journals_->path(), ::getpid(), [] { return int64_t{0}; });
}

int Replay::run(Platform& platform, const MakeRenderer& makeRenderer) {
  Application app(platform, std::make_unique<Session>(makeRenderer()));
  app.session().split().setRenderer(makeRenderer);
  start(app);
  while (!player_.finished() && !app.finished()) {
    std::vector<InputEvent> ignored;
    platform.poll(ignored, 0.0);
    for (InputEvent& event : player_.beginFrame()) app.input().push(std::move(event));
    // Only what is looked at need be rendered.
    app.skipPictures(options_.frameClock && !player_.waits());
    try {
      app.frame();
    } catch (const InputError& e) {
      throw InputError(options_.recording + ": frame " + std::to_string(player_.frame()) + ": " +
                       e.what());
    }
    if (!app.session().renderError().empty()) throw InputError(app.session().renderError());
    const bool settled = app.session().output().settled && app.quietFrames() >= kQuietFrames;
    for (const Checkpoint& checkpoint : player_.endFrame(settled)) check(app, platform, checkpoint);
  }
  if (options_.updateBaselines) writeRecording(updated_);
  const std::string latency = latencySummary(app.session().watch().latency);
  if (!latency.empty()) std::cout << latency << '\n';
  if (!options_.report.empty()) writeReport(app.session());
  if (options_.check) std::cout << passed_ << " checks passed, " << failed_ << " failed\n";
  return failed_ == 0 ? 0 : 1;
}

void Replay::writeReport(Session& session) const {
  const BackendInfo& backend = session.renderer().backend().info();
  const nlohmann::ordered_json report{{"recording", options_.recording},
                                      {"backend", backend.name},
                                      {"device", backend.device},
                                      {"frames", session.frame()},
                                      {"checks", checks_},
                                      {"actions", session.home().ran},
                                      {"edits", latencyJson(session.watch().latency)}};
  writeFile(options_.report, report.dump(2) + '\n');
}

fs::path Replay::outputOf(const Checkpoint& checkpoint, const char* ending) const {
  // A failed check leaves something to look at even when nobody said where.
  const fs::path folder = options_.outputFolder.empty() ? "out/replay" : options_.outputFolder;
  return folder / (player_.recording().path.stem().string() + "." + checkpoint.name + ending);
}

std::string Replay::documentProblem(const Session& session, const Checkpoint& checkpoint) {
  Document document = session.document();
  // The method that the command line asked for is no edit of the recording's.
  if (!options_.method.empty() && document.render.method == options_.method)
    document.render.method = header().render.method;
  const std::string hash = hashText(documentHash(document));
  if (options_.updateBaselines) {
    for (RecordingLine& line : updated_.lines)
      if (auto* c = std::get_if<Checkpoint>(&line.what); c && c->name == checkpoint.name)
        c->document = hash;
    return "";
  }
  if (checkpoint.document.empty() || checkpoint.document == hash) return "";
  return "the document is " + hash + " and should be " + checkpoint.document;
}

std::string Replay::pictureProblem(Session& session, const Image8& picture,
                                   const Checkpoint& checkpoint) {
  // Another method gives another picture.
  if (!checkpoint.image || !options_.method.empty()) return "";
  const fs::path path = player_.recording().baselineOf(checkpoint);
  if (options_.updateBaselines) {
    writePng(picture, path);
    return "";
  }
  if (!fs::exists(path))
    return "there is no " + path.filename().string() + "; write it with --update-baselines";
  const Image8 baseline = readPicture(path);
  const PictureDifference difference = comparePictures(picture, baseline);
  const bool exact = session.renderer().backend().info().name == "cpu";
  if (exact ? difference.none() : difference.within(checkpoint.max, checkpoint.mean)) return "";
  const fs::path heat = outputOf(checkpoint, ".difference.png");
  fs::create_directories(heat.parent_path());
  writePng(picture, outputOf(checkpoint, ".png"));
  if (difference.sameSize) writePng(differencePicture(picture, baseline), heat);
  return difference.text() + "; see " + heat.string();
}

void Replay::writePictures(Platform& platform, const Image8& picture,
                           const Checkpoint& checkpoint) {
  if (options_.outputFolder.empty()) return;
  fs::create_directories(options_.outputFolder);
  writePng(picture, outputOf(checkpoint, ".png"));
  if (platform.hasGl()) writePng(platform.screenshot(), outputOf(checkpoint, ".window.png"));
}

void Replay::check(Application& app, Platform& platform, const Checkpoint& checkpoint) {
  Session& session = app.session();
  const Image8 picture = session.picture();
  writePictures(platform, picture, checkpoint);
  if (!options_.check && !options_.updateBaselines) {
    std::cout << checkpoint.name << ": document " << hashText(documentHash(session.document()))
              << '\n';
    return;
  }
  std::string problem = documentProblem(session, checkpoint);
  const std::string seen = pictureProblem(session, picture, checkpoint);
  if (!problem.empty() && !seen.empty()) problem += "; ";
  problem += seen;
  (problem.empty() ? passed_ : failed_) += 1;
  checks_.push_back({{"name", checkpoint.name}, {"passed", problem.empty()}, {"problem", problem}});
  std::cout << checkpoint.name << ": "
            << (!problem.empty()           ? "FAILED: " + problem
                : options_.updateBaselines ? "written"
                                           : "passed")
            << std::endl;
}

}  // namespace

int runReplay(const ReplayOptions& options, const Stopwatch& stopwatch) {
  const ThreadLimit limit(options.threads);
  Recording recording = readRecording(options.recording);
  const RecordingHeader header = recording.header;
  Replay replay(options, std::move(recording));
  // The cpu backend gives the same bits everywhere, so that is what a replay takes unless told.
  const std::string backend = options.backend == "auto" ? "cpu" : options.backend;
  // Without a stopwatch no stage of a frame is timed.
  const auto renderer = [&] {
    return std::make_unique<FrameRenderer>(makeBackend(backend, stopwatch),
                                           options.frameClock ? Stopwatch() : stopwatch);
  };
  const std::optional<float> scale = askedUiScale();
  if (!options.headless) {
    Window window(header.width, header.height, "Lamplighter: replay", Window::Kind::fixed, scale);
    return replay.run(window, renderer);
  }
  // OpenGL is needed only by the gl backend and for pictures of the panels.
  std::unique_ptr<gl::HeadlessContext> context;
  try {
    if (backend == "gl" || !options.outputFolder.empty())
      context = std::make_unique<gl::HeadlessContext>();
  } catch (const InputError&) {
    if (backend == "gl") throw;
  }
  Headless headless(header.width, header.height, context != nullptr, scale.value_or(1.0f));
  return replay.run(headless, renderer);
}

}  // namespace lamplighter
