#include <charconv>
#include <iostream>
#include <optional>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>
#include <sys/resource.h>

#include "editor/cli/options.h"
#include "editor/cli/progress_line.h"
#include "editor/cli/subcommands.h"
#include "editor/debug_views/annotate.h"
#include "editor/debug_views/look.h"
#include "editor/debug_views/view_display.h"
#include "editor/debug_views/vpl_overlay.h"
#include "editor/document/cache_folder.h"
#include "editor/document/sky_text.h"
#include "editor/document/write_file.h"
#include "renderer/backends/many_lights_kernels.h"
#include "renderer/base/error.h"
#include "renderer/base/threads.h"
#include "renderer/debug_views/view_picture.h"
#include "renderer/frame/frame.h"
#include "renderer/image/exposure.h"
#include "renderer/image/image_io.h"
#include "renderer/image/tone_map.h"
#include "renderer/registry/registry.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter::cli {

namespace {

struct Totals {
  int frames = 0;
  std::vector<Statistic> statistics;
  std::map<std::string, double> stageSeconds;
  double loadSeconds = 0.0, renderSeconds = 0.0;
};

uint64_t peakMemoryBytes() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<uint64_t>(usage.ru_maxrss) * 1024;  // Linux counts KiB
}

// Each by its name: work of all frames, states of the last one.
void writeStatistics(const std::vector<Statistic>& statistics, nlohmann::ordered_json& j) {
  for (const auto& [spec, value] : statistics) {
    if (spec->isWhole)
      j[spec->name] = static_cast<uint64_t>(value);
    else
      j[spec->name] = value;
  }
}

std::string statsText(const RenderOptions& o, const View& view, const GiOutput& out,
                      const Totals& t, Backend& backend) {
  const BackendCounts counts = backend.counts();
  const auto* kernels = backend.kernelsInUse<ManyLightsKernels>();
  const ManyLightsCounts lights = kernels ? kernels->lightCounts() : ManyLightsCounts();
  nlohmann::ordered_json j;
  j["scene"] = o.scene;
  j["method"] = o.method;
  j["backend"] = backend.info().name;
  j["device"] = backend.info().device;
  if (backend.info().name == "gl") j["gl_renderer"] = backend.info().device;
  j["width"] = view.width;
  j["height"] = view.height;
  j["frames"] = t.frames;
  j["settled"] = out.settled;
  j["seconds"] = {{"load", t.loadSeconds},
                  {"render", t.renderSeconds},
                  {"total", t.loadSeconds + t.renderSeconds}};
  j["stages"] = t.stageSeconds;  // seconds
  writeStatistics(t.statistics, j);
  j["shadow_maps"] = lights.shadowMaps;
  j["light_pixels"] = lights.lightPixels;
  j["map_look_ups"] = lights.lookUps;
  j["rays"] = j["rays"].get<uint64_t>() + counts.rays;
  // of the backend: shadow maps, G-buffer, copies of the scene
  j["memory_bytes"] = counts.memoryBytes;
  j["peak_memory_bytes"] = peakMemoryBytes();  // of the whole process
  return j.dump(2) + "\n";
}

// Throws InputError if an EXR cannot store the requested view.
void requireRadiance(const RenderOptions& o, DebugView debugView) {
  const std::string what = !isRadiance(debugView) ? "view " + o.view + " is not"
                           : o.marks              ? "marks are not"
                           : o.legend             ? "a legend is not"
                                                  : "";
  if (!what.empty())
    throw InputError(o.output, what + " radiance and cannot be in an EXR",
                     "name a file that ends in .png");
}

// Throws InputError before the long computation if the method does not support the requested view.
void requireView(const FrameRenderer& renderer, DebugView debugView, const RenderOptions& o) {
  const Inspection inspection = renderer.inspect();
  if (o.marks && inspection.lights.empty())
    throw InputError("--marks", "there are no light samples", "omit it, or use many_lights");
  if (isRadiance(debugView)) return;
  const std::string problem = problemOf(debugView, inspection);
  if (!problem.empty()) throw InputError("--view " + o.view, problem, "or choose another view");
  const size_t count = inspection.lights.size();
  if (needsLightSample(debugView) && static_cast<size_t>(o.viewVpl) >= count)
    throw InputError("--view-vpl", "there is no light sample " + std::to_string(o.viewVpl),
                     "give one from 0 to " + std::to_string(count - 1));
}

ViewSubject subjectOf(FrameRenderer& renderer, const View& view, const Inspection& inspection,
                      DebugView debugView, int chosen, float ev, RadianceImage& radiance) {
  ViewSubject subject{renderer.scene(), *renderer.rays(), view, inspection, chosen, ev};
  subject.chosenNode = nodeOfSample(inspection, chosen);
  takeFromBackend(debugView, renderer.backend(), radiance, subject);
  return subject;
}

// Throws InputError if the sky has no picture.
void turnSky(Sky& sky, const RenderOptions& o) {
  if (!o.skyRotation && !o.skyScale) return;
  if (sky.kind != SkyKind::image) {
    throw InputError(o.skyRotation ? "--sky-rotation" : "--sky-scale", "the sky is not a picture",
                     "add --sky FILE");
  }
  if (o.skyRotation) sky.rotation = glm::radians(*o.skyRotation);
  if (o.skyScale) sky.scale = *o.skyScale;
}

}  // namespace

float exposureOf(const std::string& text, const Image& radiance) {
  if (text == "auto") return autoExposureEv(radiance);
  float ev = 0.0f;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), ev);
  if (error != std::errc() || end != text.data() + text.size() || !(ev >= -32.0f && ev <= 32.0f)) {
    throw InputError("--exposure",
                     "'" + text + "' is neither auto nor a number of EV from -32 to 32",
                     "give auto or such a number");
  }
  return ev;
}

int render(const RenderOptions& o, const Frontend& frontend) {
  // Check the whole command line before any work.
  const MethodInfo& method = findMethod(o.method);
  const Settings settings = settingsOf(o, method);
  const auto [width, height] = parseSize(o.size);
  requireWritable(o.output, {".exr", ".png"});
  if (!o.stats.empty()) requireWritable(o.stats, {});
  exposureOf(o.exposure, Image());
  const DebugView debugView = findDebugView(o.view).view;
  if (!o.output.ends_with(".png")) requireRadiance(o, debugView);
  std::optional<Font> font;
  if (o.legend) font.emplace(look::kTextFont, static_cast<int>(look::kFontSize), "--legend");

  std::optional<Sky> sky;
  if (!o.sky.empty()) sky = parseSky(o.sky);

  const ThreadLimit limit(o.threads);
  Totals totals;
  const double start = frontend.stopwatch();
  LoadedScene loaded = loadGltf(o.scene);
  if (sky) loaded.scene.sky = *sky;
  turnSky(loaded.scene.sky, o);
  for (const std::string& w : loaded.warnings) std::cerr << "warning: " << w << '\n';
  const View view = chooseView(loaded.scene, o.camera, width, height);
  totals.loadSeconds = frontend.stopwatch() - start;

  ViewDisplay display;
  display.setView(debugView);
  FrameRenderer renderer(frontend.makeBackend(o.backend), frontend.stopwatch, StageTimes::exact);
  renderer.setCacheFolder(transferFolder());
  SceneChanges changes = SceneChanges::all();
  GiOutput out;
  ProgressLine progress;
  do {
    out = renderer.render({loaded.scene,
                           changes,
                           view,
                           o.method,
                           settings,
                           display.lightOnly(),
                           {.refineUpdates = kAllAtOnce},
                           display.part()});
    if (totals.frames == 0) requireView(renderer, debugView, o);
    changes = SceneChanges();
    ++totals.frames;
    accumulate(totals.statistics, out.stats.declared);
    for (const auto& [stage, seconds] : out.stats.stageSeconds)
      totals.stageSeconds[std::string(stage.name)] += seconds;
    std::string line = fmt::format("{}: frame {}", o.method, totals.frames);
    for (const StatusText& text : statusTexts(out.stats.declared)) line += ", " + text.text;
    progress.show(line);
  } while (!out.settled || !out.refined);
  const Image& image = out.radiance->pixels();
  totals.renderSeconds = frontend.stopwatch() - start - totals.loadSeconds;

  if (o.output.ends_with(".exr")) {
    writeExr(image, o.output);
  } else {
    const Inspection inspection = renderer.inspect();
    const float ev = exposureOf(o.exposure, image);
    const View viewInUnits = renderer.world().viewOf(view);
    ViewPicture picture;
    if (isRadiance(debugView))
      picture.image = toneMap(image, ev);
    else
      picture = drawView(debugView, subjectOf(renderer, viewInUnits, inspection, debugView,
                                              o.viewVpl, ev, *out.radiance));
    if (!picture.problem.empty())
      throw InputError("--view " + o.view, picture.problem, "choose another view or sample");
    if (o.marks) {
      Overlay marks;
      drawVpls(marks, viewInUnits, inspection, *renderer.rays(),
               needsLightSample(debugView) ? o.viewVpl : kNone);
      drawOverlay(picture.image, marks, nullptr);
    }
    writePng(font ? withLegend(picture, *font) : picture.image, o.output);
  }
  if (!o.stats.empty()) writeFile(o.stats, statsText(o, view, out, totals, renderer.backend()));
  return 0;
}

int tonemap(const TonemapOptions& o) {
  requireWritable(o.output, {".png"});
  const Image image = readImage(o.input);
  const float ev = exposureOf(o.exposure, image);
  writePng(toneMap(image, ev), o.output);
  std::cout << fmt::format("EV {:g}\n", ev);
  return 0;
}

}  // namespace lamplighter::cli
