#include "tests/tools/methods_table/drag_strip.h"

#include <algorithm>
#include <iostream>
#include <map>

#include <spdlog/fmt/fmt.h>

#include "editor/debug_views/look.h"
#include "editor/split/tile_sheet.h"
#include "renderer/image/average_blocks.h"
#include "renderer/image/exposure.h"
#include "renderer/image/image_io.h"
#include "renderer/image/metrics.h"
#include "renderer/image/tone_map.h"
#include "tests/tools/methods_table/played_session.h"

namespace lamplighter {
namespace {

constexpr int kShrink = 2, kColumns = 8;
constexpr size_t kDrag = 1;             // step of the recording
constexpr double kLeastSeconds = 1e-3;  // stages that take less are not printed

}  // namespace

void writeDragStrip(const std::string& level, const std::string& method,
                    const test::LevelRecording& recording, const std::filesystem::path& file) {
  PlayedSession played(method);
  const GiOutput& output = played.session.output();
  played.meter.measure(
      [&] {
        played.session.open(recording.scene(), level, {});
        played.show(recording, recording.after(0, 1));
      },
      nullptr);
  const float ev = autoExposureEv(output.radiance->pixels());

  std::vector<Tile> tiles;
  Image last = averageBlocks(output.radiance->pixels(), PlayedSession::kBlock);
  // Returns the change from the picture before.
  const auto add = [&](const std::string& title) {
    const Image& picture = output.radiance->pixels();
    tiles.push_back({toneMap(averageBlocks(picture, kShrink), ev), title, {}});
    const Image before = std::exchange(last, averageBlocks(picture, PlayedSession::kBlock));
    return relRmse(last, before);
  };
  const int frames = test::LevelRecording::kSteps[kDrag].frames;
  std::vector<double> moving;
  std::map<std::string_view, double> stages;  // seconds of a frame
  for (int frame = 1; frame <= frames; ++frame) {
    const double time =
        played.meter.frame([&] { played.show(recording, recording.after(kDrag, frame)); });
    moving.push_back(add(fmt::format("{}: {:.0f} ms", frame, 1e3 * time)));
    for (const auto& [stage, seconds] : output.stats.stageSeconds)
      stages[stage.name] += seconds / frames;
  }
  played.meter.frame([] {});
  const double atRest = add("at rest");
  played.meter.measure([] {}, nullptr);
  const double settled = add("settled");
  std::ranges::sort(moving);
  std::cout << fmt::format("{},\"{}\",{:.4f},{:.4f},{:.4f},{:.4f},", level, method,
                           moving[moving.size() / 2], moving.back(), atRest, settled);
  for (const auto& [name, seconds] : stages)
    if (seconds >= kLeastSeconds) std::cout << fmt::format("{} {:.0f} ms; ", name, 1e3 * seconds);
  std::cout << std::endl;
  const Font font(look::kTextFont, static_cast<int>(look::kFontSize), "tiles");
  writePng(tileSheet(tiles, kColumns, font), file);
}

}  // namespace lamplighter
