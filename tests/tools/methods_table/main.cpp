// Plays one recording (tests/support/level_recording.h) on a level with one method, paced as in the
// editor's window, and compares every frame with the reference.
//   lamplighter_methods_table LEVEL METHOD REFERENCES [CURVES]
//   lamplighter_methods_table LEVEL METHOD strip FILE.png   (drag_strip.h)
// METHOD: a method, with its parameters as in "many_lights,indirect=samples", or a preset as
// "preset.draft"; "truth" writes the references, pictures of the path tracer after each step, into
// the folder REFERENCES, and prints the paths per pixel and the noise of the worst of them. Prints
// a row of CSV for each step; to CURVES it appends the error over time.
#include <array>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <numeric>

#include <spdlog/fmt/fmt.h>
#include <sys/resource.h>

#include "editor/cli/options.h"
#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/base/error.h"
#include "renderer/frame/frame.h"
#include "renderer/image/average_blocks.h"
#include "renderer/image/image_io.h"
#include "renderer/image/metrics.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/level_recording.h"
#include "tests/tools/methods_table/drag_strip.h"
#include "tests/tools/methods_table/played_session.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;
using test::LevelRecording;

// Maximum number of paths of a reference; paths are added in passes until its noise is small
// enough.
constexpr int kPathsOfPass = 32, kMostPaths = 256;
constexpr double kNoise = 0.01;
// Not that of the method reference, whose noise would be the same.
constexpr int kSeed = 77;
constexpr int kBlock = PlayedSession::kBlock;
// Time for which each step is measured after its last frame of motion [s].
constexpr double kSeconds = 8.0;
// A row of the curves where time has grown by this factor.
constexpr double kRowFactor = 1.25;

fs::path referenceFile(const fs::path& folder, size_t step) {
  return folder / fmt::format("{}.exr", step);
}

// By the method reference with its defaults, so that gloss is shown as every method shows it.
Image tracedPass(FrameRenderer& renderer, const Scene& scene, const View& view, int pass) {
  Settings settings;
  settings.set("samples_per_pixel", kPathsOfPass);
  settings.set("bounces", PlayedSession::kBounces);
  settings.set("seed", kSeed + pass);
  const std::string method = "reference";
  SceneChanges changes = pass == 0 ? SceneChanges::all() : SceneChanges();
  GiOutput out;
  while (!out.settled)
    out = renderer.render({scene, std::exchange(changes, {}), view, method, settings});
  return out.radiance->pixels();
}

struct Traced {
  Image mean;
  int paths = 0;
  double noise = 0.0;  // relRMSE of its blocks
};

// The noise is half the difference between the means of odd and even passes.
Traced traced(const Scene& scene, const View& view) {
  FrameRenderer renderer(makeCpuBackend());
  std::array<Image, 2> sums = {Image(view.width, view.height), Image(view.width, view.height)};
  Traced out;
  do {
    for (Image& sum : sums) {
      const Image pass = tracedPass(renderer, scene, view, out.paths / kPathsOfPass);
      for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += pass.pixels[i];
      out.paths += kPathsOfPass;
    }
    out.noise = 0.5 * relRmse(averageBlocks(sums[0], kBlock), averageBlocks(sums[1], kBlock));
  } while (out.noise > kNoise && out.paths < kMostPaths);
  out.mean = sums[0];
  for (size_t i = 0; i < out.mean.pixels.size(); ++i)
    out.mean.pixels[i] = (out.mean.pixels[i] + sums[1].pixels[i]) *
                         (static_cast<float>(kPathsOfPass) / static_cast<float>(out.paths));
  return out;
}

void writeReferences(const LevelRecording& recording, const fs::path& folder) {
  fs::create_directories(folder);
  Scene scene = recording.scene();
  Traced worst;
  for (size_t step = 0; step < LevelRecording::kSteps.size(); ++step) {
    const auto state = recording.after(step, LevelRecording::kSteps[step].frames);
    recording.apply(state, scene);
    const Traced found = traced(scene, state.view);
    if (found.noise >= worst.noise) worst = {{}, found.paths, found.noise};
    writeExr(found.mean, referenceFile(folder, step));
  }
  std::cout << fmt::format("{},{:.4f}\n", worst.paths, worst.noise);
}

// Of the process, so far.
double peakMebibytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

std::string orNever(const std::optional<double>& value) {
  return value ? fmt::format("{:.2f}", *value) : "never";
}

void play(const std::string& level, const std::string& method, const LevelRecording& recording,
          const fs::path& references, std::ostream* curves) {
  PlayedSession played(method);
  for (size_t step = 0; step < LevelRecording::kSteps.size(); ++step) {
    const auto& [name, frames] = LevelRecording::kSteps[step];
    const Image truth = averageBlocks(readImage(referenceFile(references, step)), kBlock);
    const auto errorOf = [&](const Image& picture) {
      return relRmse(averageBlocks(picture, kBlock), truth);
    };
    std::vector<double> moving;
    for (int frame = 1; frame < frames; ++frame)
      moving.push_back(
          played.meter.frame([&] { played.show(recording, recording.after(step, frame)); }));
    const Convergence last = played.meter.measure(
        [&] {
          if (step == 0) played.session.open(recording.scene(), level, {});
          played.show(recording, recording.after(step, frames));
        },
        errorOf, kSeconds);
    moving.push_back(last.firstFrame);
    const double mean =
        std::accumulate(moving.begin(), moving.end(), 0.0) / static_cast<double>(moving.size());
    std::cout << fmt::format("{},\"{}\",{},{:.0f},{:.0f},{:.4f},{},{},{},{:.4f},{},{:.0f}", level,
                             method, name, 1e3 * mean, 1e3 * *std::ranges::max_element(moving),
                             last.curve.front().error, orNever(last.secondsToStayBelow(0.1)),
                             orNever(last.secondsToStayBelow(0.05)), orNever(last.settled),
                             last.curve.back().error, last.frames, peakMebibytes())
              << std::endl;
    if (curves == nullptr) continue;
    for (const auto& [time, error] : last.thinnedCurve(kRowFactor))
      *curves << fmt::format("{},\"{}\",{},{:.3f},{:.4f}\n", level, method, name, time, error);
  }
}

int run(int argc, char** argv) {
  if (argc < 4) {
    std::cerr << "usage: lamplighter_methods_table LEVEL METHOD REFERENCES [CURVES]\n"
                 "       lamplighter_methods_table LEVEL METHOD strip FILE.png\n";
    return 2;
  }
  const fs::path file = argv[1];
  const std::string method = argv[2];
  Scene scene = loadGltf(file).scene;
  const View view = cli::chooseView(scene, "", PlayedSession::kWidth, PlayedSession::kHeight);
  const LevelRecording recording(std::move(scene), view);
  if (method == "truth") {
    writeReferences(recording, argv[3]);
    return 0;
  }
  if (argc == 5 && std::string_view(argv[3]) == "strip") {
    writeDragStrip(file.stem().string(), method, recording, argv[4]);
    return 0;
  }
  std::ofstream curves;
  if (argc > 4) curves.open(argv[4], std::ios::app);
  play(file.stem().string(), method, recording, argv[3], argc > 4 ? &curves : nullptr);
  return 0;
}

}  // namespace
}  // namespace lamplighter

int main(int argc, char** argv) {
  try {
    return lamplighter::run(argc, argv);
  } catch (const std::exception& e) {
    std::cerr << "lamplighter_methods_table: " << e.what() << '\n';
    return 2;
  }
}
