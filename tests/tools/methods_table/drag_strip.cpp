#include "tests/tools/methods_table/drag_strip.h"

#include <algorithm>
#include <chrono>
#include <iostream>

#include <spdlog/fmt/fmt.h>

#include "editor/convergence/convergence_meter.h"
#include "editor/debug_views/look.h"
#include "editor/session/session.h"
#include "editor/split/split_view.h"
#include "editor/split/tile_sheet.h"
#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/image/average_blocks.h"
#include "renderer/image/exposure.h"
#include "renderer/image/image_io.h"
#include "renderer/image/metrics.h"
#include "renderer/image/tone_map.h"
#include "tests/tools/methods_table/shown_state.h"

namespace lamplighter {
namespace {

constexpr int kWidth = 320, kHeight = 240, kShrink = 2, kBlock = 4, kColumns = 8, kBounces = 5;
constexpr size_t kDrag = 1;  // step of the recording

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

void writeDragStrip(const std::string& level, const std::string& method,
                    const test::LevelRecording& recording, const std::filesystem::path& file) {
  Session session(std::make_unique<FrameRenderer>(makeCpuBackend(), seconds, StageTimes::exact));
  session.resizeViewport(kWidth, kHeight);
  RenderSettings render = readSide(method, "").of({});
  render.values.set("bounces", kBounces);
  session.editing().setInitialRender(render);
  ConvergenceMeter meter(session, seconds);
  meter.measure(
      [&] {
        session.open(recording.scene(), level, {});
        show(session, recording, recording.after(0, 1));
      },
      nullptr);
  const float ev = autoExposureEv(session.output().radiance->pixels());

  std::vector<Tile> tiles;
  std::vector<double> changes;
  Image last = averageBlocks(session.output().radiance->pixels(), kBlock);
  const auto add = [&](const std::string& title) {
    const Image& picture = session.output().radiance->pixels();
    tiles.push_back({toneMap(averageBlocks(picture, kShrink), ev), title, {}});
    Image now = averageBlocks(picture, kBlock);
    changes.push_back(relRmse(now, last));
    last = std::move(now);
  };
  const int frames = test::LevelRecording::kSteps[kDrag].frames;
  for (int frame = 1; frame <= frames; ++frame) {
    const double time =
        meter.frame([&] { show(session, recording, recording.after(kDrag, frame)); });
    add(fmt::format("{}: {:.0f} ms", frame, 1e3 * time));
  }
  std::vector<double> moving = changes;
  std::ranges::sort(moving);
  meter.frame([] {});
  add("at rest");
  meter.measure([] {}, nullptr);
  add("settled");
  std::cout << fmt::format("{},\"{}\",{:.4f},{:.4f},{:.4f},{:.4f}\n", level, method,
                           moving[moving.size() / 2], moving.back(), changes[changes.size() - 2],
                           changes.back());
  const Font font(look::kTextFont, static_cast<int>(look::kFontSize), "tiles");
  writePng(tileSheet(tiles, kColumns, font), file);
}

}  // namespace lamplighter
