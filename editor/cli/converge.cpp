// Measures the error of the live picture against a reference over the time since an edit.
#include <cmath>
#include <iostream>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "editor/cli/options.h"
#include "editor/cli/progress_line.h"
#include "editor/cli/subcommands.h"
#include "editor/convergence/convergence_meter.h"
#include "editor/convergence/scene_move.h"
#include "editor/document/cache_folder.h"
#include "renderer/base/error.h"
#include "renderer/base/threads.h"
#include "renderer/image/average_blocks.h"
#include "renderer/image/image_io.h"
#include "renderer/image/metrics.h"
#include "renderer/registry/registry.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter::cli {
namespace {

// Rows of the output: the time from one to the next grows at least by this factor.
constexpr double kRowFactor = 1.15;

class Reference {
 public:
  // Pictures of one size; compares means of block × block pixels.
  Reference(const Image& picture, std::optional<Image> mask, int block)
      : block_(block), mask_(std::move(mask)), blocks_(blocksOf(picture)) {
    if (mask_) blockMask_ = blockMask(*mask_, block);
  }
  double errorOf(const Image& image) const {
    return relRmse(blocksOf(image), blocks_, blockMask_ ? &*blockMask_ : nullptr);
  }

 private:
  Image blocksOf(const Image& image) const {
    return averageBlocks(image, block_, mask_ ? &*mask_ : nullptr);
  }

  int block_;
  std::optional<Image> mask_, blockMask_;
  Image blocks_;
};

Image readOfSize(const std::string& file, int width, int height) {
  Image image = readImage(file);
  if (image.width != width || image.height != height)
    throw InputError(file,
                     fmt::format("the picture has {}x{} pixels, and not the {}x{} of the view",
                                 image.width, image.height, width, height),
                     fmt::format("add --size {}x{}, or name another", image.width, image.height));
  return image;
}

Reference readReference(const ConvergeOptions& o, int width, int height) {
  std::optional<Image> mask;
  if (!o.mask.empty()) mask = readOfSize(o.mask, width, height);
  Reference reference(readOfSize(o.against, width, height), std::move(mask), o.block);
  // The error of a black picture is at least 1, unless the reference is black, too.
  const double ofBlack = reference.errorOf(Image(width, height));
  if (!(ofBlack > 0.0 && std::isfinite(ofBlack)))
    throw InputError(o.against, "is black or has pixels that are not finite",
                     "name a picture of the lit scene");
  return reference;
}

Scene load(const std::string& path) {
  LoadedScene loaded = loadGltf(path);
  for (const std::string& w : loaded.warnings) std::cerr << "warning: " << w << '\n';
  return std::move(loaded.scene);
}

// Throws InputError if there is nothing to move.
SceneMove findMove(const Scene& from, const Scene& to, const ConvergeOptions& o) {
  SceneMove move = moveTo(from, to);
  if (move.common == 0)
    throw InputError(o.to, "no node has the name of a node of " + o.from,
                     "name another state of the same level");
  if (move.none())
    throw InputError(o.to, "has every object and light in the same place and state as " + o.from,
                     "name a state of the level in which something moved");
  return move;
}

// For JSON; a value that there is not is null.
nlohmann::ordered_json orNull(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}
nlohmann::ordered_json orNull(const std::string& text) {
  return text.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(text);
}

std::string jsonText(const ConvergeOptions& o, const BackendInfo& backend,
                     const Convergence& opening, const Convergence& measured) {
  nlohmann::ordered_json curve = nlohmann::ordered_json::array();
  for (const auto& [seconds, error] : measured.thinnedCurve(kRowFactor))
    curve.push_back({{"seconds", seconds}, {"error", error}});
  const nlohmann::ordered_json j{
      {"from", o.from},
      {"to", orNull(o.to)},
      {"against", o.against},
      {"mask", orNull(o.mask)},
      {"block", o.block},
      {"method", o.method},
      {"backend", backend.name},
      {"device", backend.device},
      {"opening", {{"first_frame", opening.firstFrame}, {"settled", orNull(opening.settled)}}},
      {"curve", std::move(curve)},
      {"first_frame", measured.firstFrame},
      {"to_10", orNull(measured.secondsToStayBelow(0.1))},
      {"to_5", orNull(measured.secondsToStayBelow(0.05))},
      {"settled", orNull(measured.settled)},
      {"end", measured.curve.back().error},
      {"frames", measured.frames},
      {"stages", measured.stageSeconds}};
  return j.dump(2) + '\n';
}

std::string secondsText(const std::optional<double>& seconds) {
  return seconds ? fmt::format("{:.3f} s", *seconds) : "never";
}

std::string tableText(const Convergence& opening, const Convergence& measured) {
  std::string text = "  seconds    error\n";
  for (const auto& [seconds, error] : measured.thinnedCurve(kRowFactor))
    text += fmt::format("{:9.3f} {:7.2f}%\n", seconds, 100.0 * error);
  text += fmt::format("\nopening      {} to the first frame, settled {}\n",
                      secondsText(opening.firstFrame), secondsText(opening.settled));
  text += fmt::format("first_frame  {}\n", secondsText(measured.firstFrame));
  text += fmt::format("to_10        {}\n", secondsText(measured.secondsToStayBelow(0.1)));
  text += fmt::format("to_5         {}\n", secondsText(measured.secondsToStayBelow(0.05)));
  text += fmt::format("settled      {}\n", secondsText(measured.settled));
  return text + fmt::format("end          {:.2f}%\n", 100.0 * measured.curve.back().error);
}

// From opening FROM, and from the edit that makes it TO; without TO the last is the first.
struct Measured {
  Convergence opening, last;
};

Measured measure(Session& session, const Stopwatch& clock, const Reference& reference,
                 const Scene& to, const ConvergeOptions& o) {
  ConvergenceMeter meter(session, clock);
  ProgressLine progress;
  const auto errorOf = [&](const Image& picture) {
    const double error = reference.errorOf(picture);
    progress.show(fmt::format("{}: error {:.2f}%", o.method, 100.0 * error));
    return error;
  };
  const bool moves = !o.to.empty();
  SceneMove move;
  const auto open = [&] {
    session.open(load(o.from), o.from, {});
    const Scene& from = session.document().scene;
    const auto [width, height] = parseSize(o.size);
    if (!o.camera.empty()) session.setView(chooseView(from, o.camera, width, height));
    if (moves) move = findMove(from, to, o);  // takes no time worth mentioning
  };
  if (!moves) {
    const Convergence opening = meter.measure(open, errorOf, o.seconds);
    return {opening, opening};
  }
  Convergence opening = meter.measure(open, nullptr);
  return {std::move(opening),
          meter.measure([&] { applyMove(session.editing(), move); }, errorOf, o.seconds)};
}

}  // namespace

int converge(const ConvergeOptions& o, const Frontend& frontend) {
  // Check the whole command line before any work.
  const MethodInfo& method = findMethod(o.method);
  RenderSettings render{o.method, {}, 0.0f};
  applyFlags(render.values, o, method);
  const auto [width, height] = parseSize(o.size);
  const Reference reference = readReference(o, width, height);
  const Scene to = o.to.empty() ? Scene() : load(o.to);

  const ThreadLimit limit(o.threads);
  Session session(std::make_unique<FrameRenderer>(frontend.makeBackend(o.backend),
                                                  frontend.stopwatch, StageTimes::exact));
  session.renderer().setCacheFolder(transferFolder());
  session.resizeViewport(width, height);
  session.editing().setInitialRender(std::move(render));
  const auto [opening, last] = measure(session, frontend.stopwatch, reference, to, o);
  std::cout << (o.json ? jsonText(o, session.renderer().backend().info(), opening, last)
                       : tableText(opening, last));
  return 0;
}

}  // namespace lamplighter::cli
