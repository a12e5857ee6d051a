// Renders a level with several methods, or one with other parameters, and writes the pictures as
// tiles with figures under each.
#include <algorithm>
#include <iostream>

#include <spdlog/fmt/fmt.h>

#include "editor/cli/options.h"
#include "editor/cli/progress_line.h"
#include "editor/cli/subcommands.h"
#include "editor/convergence/convergence_meter.h"
#include "editor/debug_views/look.h"
#include "editor/document/cache_folder.h"
#include "editor/split/split_side.h"
#include "editor/split/tile_errors.h"
#include "editor/split/tile_sheet.h"
#include "renderer/base/error.h"
#include "renderer/base/threads.h"
#include "renderer/image/image_io.h"
#include "renderer/image/tone_map.h"
#include "renderer/methods/path_tracer/reference_method.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter::cli {
namespace {

struct Rendered {
  std::string side;
  Image picture;
  Convergence time;
};

Rendered renderSide(const std::string& text, const Scene& scene, const TilesOptions& o,
                    const Frontend& frontend) {
  Session session(std::make_unique<FrameRenderer>(frontend.makeBackend(o.backend),
                                                  frontend.stopwatch, StageTimes::exact));
  session.renderer().setCacheFolder(transferFolder());
  const auto [width, height] = parseSize(o.size);
  session.resizeViewport(width, height);
  session.editing().setInitialRender(readSide(text, "").of({}));
  ConvergenceMeter meter(session, frontend.stopwatch);
  Convergence time = meter.measure(
      [&] {
        session.open(scene, o.scene, {});
        session.setView(chooseView(scene, o.camera, width, height));
      },
      nullptr, o.seconds);
  return {text, session.output().radiance->pixels(), std::move(time)};
}

std::vector<std::string> figuresOf(const Rendered& r, const Rendered* reference) {
  std::vector<std::string> figures{
      r.time.settled
          ? fmt::format("settled after {:.2f} s, {} frames in all", *r.time.settled, r.time.frames)
          : fmt::format("not settled after {} frames", r.time.frames)};
  if (reference != nullptr && reference != &r)
    figures.push_back(fmt::format(
        "{:.1f}% from {}", 100.0 * tileError(r.picture, reference->picture), reference->side));
  return figures;
}

}  // namespace

int tiles(const TilesOptions& o, const Frontend& frontend) {
  // Check the whole command line before any work.
  requireWritable(o.output, {".png"});
  const std::vector<std::string> sides = o.sides.empty() ? methodsOfLight() : o.sides;
  for (const std::string& side : sides)
    if (readSide(side, "many_lights").method.empty())
      throw InputError("--side " + side, "is not a method", "name one of 'lamplighter methods'");
  parseSize(o.size);
  exposureOf(o.exposure, Image());
  const Font font(look::kTextFont, static_cast<int>(look::kFontSize), "tiles");

  const ThreadLimit limit(o.threads);
  LoadedScene loaded = loadGltf(o.scene);
  for (const std::string& w : loaded.warnings) std::cerr << "warning: " << w << '\n';
  std::vector<Rendered> rendered;
  ProgressLine progress;
  for (const std::string& side : sides) {
    progress.show(fmt::format("{}, {} of {}", side, rendered.size() + 1, sides.size()));
    rendered.push_back(renderSide(side, loaded.scene, o, frontend));
  }
  const auto isReference = [](const Rendered& r) { return r.side.starts_with(kReferenceMethod); };
  const auto found = std::ranges::find_if(rendered, isReference);
  const Rendered* reference = found == rendered.end() ? nullptr : &*found;
  // One exposure for all: that of the reference or of the first.
  const float ev =
      exposureOf(o.exposure, reference != nullptr ? reference->picture : rendered.front().picture);
  std::vector<Tile> sheet;
  for (const Rendered& r : rendered)
    sheet.push_back({toneMap(r.picture, ev), r.side, figuresOf(r, reference)});
  writePng(tileSheet(sheet, o.columns, font), o.output);
  return 0;
}

}  // namespace lamplighter::cli
