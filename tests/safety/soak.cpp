// The soak test. Makes seeded random edits for a given time, and checks that memory does not grow,
// that there is no OpenGL error, and that the picture equals that of a new renderer:
//   lamplighter_soak [--backend cpu|gl] [--minutes N | --steps N] [--seed S] [--every STEPS]
//                    [--trace STEP]
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <unistd.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/base/error.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/safety/random_edits.h"
#include "tests/support/folders.h"

namespace lamplighter::test {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::string backend = "cpu";
  double minutes = 0.0;
  long steps = 300;
  uint64_t seed = 1;
  long every = 50;   // steps between comparisons with a new renderer
  long traced = -1;  // the first step that is printed
};

double residentMebibytes() {
  std::ifstream in("/proc/self/statm");
  double total = 0.0, resident = 0.0;
  in >> total >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / (1 << 20);
}

class Soak {
 public:
  explicit Soak(const Options& options)
      : options_(options),
        folder_(fs::temp_directory_path() / ("soak-" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    if (options.backend == "gl") context_ = std::make_unique<gl::HeadlessContext>(true);
    session_ = std::make_unique<Session>(std::make_unique<FrameRenderer>(backend()));
    session_->keepJournal(folder_ / "journal", ::getpid(), [] { return int64_t{0}; });
    session_->resizeViewport(96, 64);
    edits_ = std::make_unique<RandomEdits>(*session_, options.seed, RandomEdits::Limits{60, true});
  }
  ~Soak() {
    session_.reset();
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }

  int run();

 private:
  std::unique_ptr<Backend> backend() { return context_ ? makeGlBackend() : makeCpuBackend(); }
  void open();
  void step();
  bool settle();
  void compareWithFreshStart();
  void fail(const std::string& what) {
    std::printf("step %ld: %s\n", step_, what.c_str());
    ++failures_;
  }

  Options options_;
  fs::path folder_;
  std::unique_ptr<gl::HeadlessContext> context_;
  std::unique_ptr<Session> session_;
  std::unique_ptr<RandomEdits> edits_;
  long step_ = 0, comparisons_ = 0, opened_ = 0, saves_ = 0, failures_ = 0;
};

void Soak::open() {
  static const char* const kLevels[] = {"assets/scenes/default.gltf",
                                        "../shared/scenes/cornell-box/cornell-box.glb"};
  fs::path level = test::sourceFolder() / kLevels[edits_->below(2)];
  if (!fs::exists(level)) level = test::sourceFolder() / kLevels[0];
  session_->open(loadGltf(level).scene, level, {});
  RenderSettings render;
  render.values.set("vpls", 32);
  render.values.set("map_resolution", 16);
  render.values.set("spp", 2);
  session_->setRender(render);
  ++opened_;
}

void Soak::step() {
  const uint32_t kind = edits_->below(100);
  std::string what = "file";
  if (kind == 0) {
    open();
  } else if (kind < 3) {
    session_->save(folder_ / (kind == 1 ? "saved.glb" : "saved.gltf"), true);
    ++saves_;
  } else if (kind == 3) {
    session_->autosave();
  } else {
    what = edits_->step();
  }
  if (options_.traced >= 0 && step_ >= options_.traced)
    std::printf("step %ld: %s (%s)\n", step_, what.c_str(), session_->status().c_str());
  session_->renderFrame();
  if (!session_->renderError().empty()) fail("a frame failed: " + session_->renderError());
  if (context_)
    for (const std::string& error : context_->debugLog()->errors()) fail("OpenGL: " + error);
  if (context_) context_->debugLog()->clear();
}

bool Soak::settle() {
  for (int i = 0; i < 3000; ++i)
    if (session_->renderFrame().settled) return true;
  fail("the picture does not settle");
  return false;
}

void Soak::compareWithFreshStart() {
  if (session_->document().render.method == "reference") session_->runAction("render.reference");
  if (!settle()) return;
  ++comparisons_;
  FrameRenderer fresh(backend());
  const Document& d = session_->document();
  GiOutput out;
  for (int i = 0; i < 3000 && !out.settled; ++i) {
    const SceneChanges changes = i == 0 ? SceneChanges::all() : SceneChanges();
    out = fresh.render({d.scene, changes, session_->view(), d.render.method, d.render.values});
  }
  const Image live = session_->output().radiance->pixels(), anew = out.radiance->pixels();
  double worst = 0.0;
  for (size_t i = 0; i < live.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      worst = std::max(worst, std::abs(static_cast<double>(live.pixels[i][c]) -
                                       static_cast<double>(anew.pixels[i][c])) /
                                  (1e-3 + std::abs(static_cast<double>(anew.pixels[i][c]))));
  const bool isSame =
      live.pixels.size() == anew.pixels.size() &&
      std::memcmp(live.pixels.data(), anew.pixels.data(), live.pixels.size() * sizeof(vec3)) == 0;
  if (isSame) return;
  // Resets the data of the method, but not the incrementally updated scene and ray caster.
  session_->renderer().restart();
  settle();
  const bool isOfMethod = session_->output().radiance->pixels().pixels == anew.pixels;
  fail("the picture differs from that of a new renderer, by " + std::to_string(worst) +
       (isOfMethod ? "; the method caused it" : "; the scene or its ray caster caused it"));
}

int Soak::run() {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const auto elapsed = [&] {
    return std::chrono::duration<double>(Clock::now() - start).count() / 60.0;
  };
  open();
  // The memory of a level varies, so the maxima of the second and the last quarter are compared.
  std::vector<double> memory;
  const auto goesOn = [&] {
    return options_.minutes > 0.0 ? elapsed() < options_.minutes : step_ < options_.steps;
  };
  for (; goesOn() && failures_ < 10; ++step_) {
    step();
    if (step_ % options_.every == options_.every - 1) compareWithFreshStart();
    if (step_ % 10 == 9) memory.push_back(residentMebibytes());
  }
  session_->crashRecovery().close();
  const size_t quarter = memory.size() / 4;
  double early = 0.0, late = 0.0;
  if (quarter > 0) {
    // The first quarter is warm-up.
    early = *std::max_element(memory.begin() + quarter, memory.begin() + 2 * quarter);
    late = *std::max_element(memory.end() - quarter, memory.end());
    // Allocators keep some memory. A leak of one picture per step would exceed this limit by far.
    if (late > 1.15 * early + 24.0) fail("memory grew");
  }
  std::printf(
      "%s: %ld steps, seed %llu, %.1f min, %ld levels opened, %ld saves, %ld comparisons with a "
      "fresh start, memory %.0f MiB in the second quarter, %.0f MiB in the last, %ld failures\n",
      options_.backend.c_str(), step_, static_cast<unsigned long long>(options_.seed), elapsed(),
      opened_, saves_, comparisons_, early, late, failures_);
  return failures_ == 0 ? 0 : 1;
}

}  // namespace
}  // namespace lamplighter::test

int main(int argc, char** argv) {
  lamplighter::test::Options options;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string name = argv[i], value = argv[i + 1];
    if (name == "--backend")
      options.backend = value;
    else if (name == "--minutes")
      options.minutes = std::atof(value.c_str());
    else if (name == "--steps")
      options.steps = std::atol(value.c_str());
    else if (name == "--every")
      options.every = std::max(1L, std::atol(value.c_str()));
    else if (name == "--trace")
      options.traced = std::atol(value.c_str());
    else if (name == "--seed")
      options.seed = std::strtoull(value.c_str(), nullptr, 10);
    else {
      std::fprintf(stderr, "error: no option '%s'; see the head of soak.cpp\n", name.c_str());
      return 2;
    }
  }
  try {
    return lamplighter::test::Soak(options).run();
  } catch (const lamplighter::InputError& e) {
    std::fprintf(stderr, "error: %s\n", e.what());
    return 2;
  }
}
