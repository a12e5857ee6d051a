// Bakes light maps from the command line, on one machine or on several.
#include <charconv>
#include <iostream>

#include <spdlog/fmt/fmt.h>

#include "editor/bake/bake_job.h"
#include "editor/cli/options.h"
#include "editor/cli/progress_line.h"
#include "editor/cli/subcommands.h"
#include "renderer/base/error.h"
#include "renderer/base/threads.h"
#include "renderer/methods/many_lights/parameters.h"
#include "renderer/methods/path_tracer/parameters.h"
#include "renderer/registry/registry.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter::cli {
namespace {

constexpr int kCancelled = 130;  // as shells report Ctrl+C
constexpr int kMostShards = 100000;
// If standard error is not a terminal, prints a line after each tenth of the work.
constexpr int kTenths = 10;

// "2/8": the second of eight. Throws InputError.
std::pair<int, int> parseShard(const std::string& text) {
  int shard = 0, shards = 0;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, shard);
  if (first.ec == std::errc() && first.ptr != end && *first.ptr == '/') {
    const auto second = std::from_chars(first.ptr + 1, end, shards);
    if (second.ec == std::errc() && second.ptr == end && shard >= 1 && shard <= shards &&
        shards <= kMostShards)
      return {shard, shards};
  }
  throw InputError("--shard", "'" + text + "' is not a shard such as 2/8",
                   "give a number from 1 to n, a slash and n");
}

std::string timeText(double seconds) {
  const int s = static_cast<int>(seconds + 0.5);
  if (s >= 3600) return fmt::format("{} h {:02} min", s / 3600, s / 60 % 60);
  return s >= 60 ? fmt::format("{} min {:02} s", s / 60, s % 60) : fmt::format("{} s", s);
}

BakeLightOptions lightOf(const BakeOptions& o) {
  const MethodInfo& method = findMethod(o.method);
  Settings settings = settingsOf(o, method);
  // Exact soft shadows, and fewer rays.
  if (o.method == "multi_mesh" && !settings.values().contains("mask"))
    settings.set("mask", std::string("32"));
  BakeLightOptions light;
  if (o.method == "reference") {
    const PathTracerParameters parameters = pathTracerParameters().read(settings);
    light.method = BakeMethod::reference;
    light.paths.bounces = parameters.bounces;
    light.paths.seed = static_cast<uint32_t>(parameters.seed);
    light.samples = parameters.samplesPerPixel;
    return light;
  }
  // Those of multi_mesh have the same names.
  const ManyLightsParameters parameters = manyLightsParameters().read(settings);
  light.counts.total = parameters.vpls;
  light.counts.directShare = parameters.directShare;
  light.counts.bounces = parameters.bounces;
  light.counts.seed = static_cast<uint32_t>(parameters.seed);
  light.clampDistance = parameters.clampDistance;
  if (o.method == "multi_mesh") {
    light.method = BakeMethod::meshes;
    light.surface = parameters.surfaceLight(parameters.bounces, parameters.seed);
  }
  return light;
}

}  // namespace

int bake(const BakeOptions& o, const Frontend& frontend) {
  BakeJobOptions job;
  job.atlas = o.atlas;
  job.light = lightOf(o);
  if (!o.shard.empty()) std::tie(job.shard, job.shards) = parseShard(o.shard);
  job.mergeOnly = o.merge;
  job.keepParts = o.keepParts;
  job.output = o.output;
  job.name = std::filesystem::path(o.scene).stem().string();
  std::error_code ignored;
  if (std::filesystem::equivalent(std::filesystem::path(o.scene).parent_path() / ".",
                                  job.output / ".", ignored))
    throw InputError(o.output, "is the folder of the scene itself, which the copy would replace",
                     "name another folder");

  const ThreadLimit limit(o.threads);
  LoadedScene loaded = loadGltf(o.scene);
  for (const std::string& w : loaded.warnings) std::cerr << "warning: " << w << '\n';
  const auto isInterrupted = frontend.catchInterrupts();
  ProgressLine line;
  const double start = frontend.stopwatch();
  int told = 0;
  const BakeReport report = lamplighter::bake(loaded.scene, job, [&](int done, int all) {
    const double seconds = frontend.stopwatch() - start;
    const std::string text = fmt::format("bake: {} of {} tiles, {} left", done, all,
                                         timeText(seconds / done * (all - done)));
    line.show(text);
    if (!line.isTerminal() && done * kTenths / all > told) {
      told = done * kTenths / all;
      std::cerr << text << '\n';
    }
    return !isInterrupted();
  });
  line.show("");
  for (const std::string& w : report.warnings) std::cerr << "warning: " << w << '\n';
  if (report.isCancelled) {
    std::cerr << fmt::format("bake: stopped with {} of {} tiles found; the same command goes on\n",
                             report.taken + report.found, report.tiles);
    return kCancelled;
  }
  std::cout << fmt::format("{} tiles of {} pages: {} found now, {} before\n", report.tiles,
                           report.pages, report.found, report.taken);
  for (const auto& file : report.files) std::cout << file.string() << '\n';
  return 0;
}

}  // namespace lamplighter::cli
