#include "tests/tools/methods_table/played_session.h"

#include <algorithm>
#include <chrono>
#include <string_view>

#include "editor/presets/presets.h"
#include "editor/split/split_side.h"
#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/base/error.h"

namespace lamplighter {
namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

constexpr std::string_view kPreset = "preset.";

// A method with parameters, or a preset of quality.
RenderSettings settingsOf(const std::string& method) {
  if (!method.starts_with(kPreset)) return readSide(method, "").of({});
  const auto preset = std::ranges::find(presets(), method.substr(kPreset.size()), &Preset::name);
  if (preset == presets().end())
    throw InputError(method, "is not a preset", "give preset.draft, preset.work or preset.final");
  return withPreset({}, *preset);
}

}  // namespace

PlayedSession::PlayedSession(const std::string& method)
    : session(std::make_unique<FrameRenderer>(makeCpuBackend(), seconds, StageTimes::exact)),
      meter(session, seconds) {
  session.resizeViewport(kWidth, kHeight);
  RenderSettings render = settingsOf(method);
  render.values.set("bounces", kBounces);
  session.editing().setInitialRender(render);
}

void PlayedSession::show(const test::LevelRecording& recording,
                         const test::LevelRecording::State& state) {
  const Scene& scene = session.document().scene;
  const auto moveTo = [&](NodeId id, const vec3& position) {
    Transform local = scene.find(id)->local;
    if (local.translation == position) return;
    local.translation = position;
    session.setNodeTransform(id, local);
  };
  moveTo(recording.lamp(), state.lamp);
  moveTo(recording.box(), state.box);
  AreaLight light = *scene.find(recording.lamp())->area;
  if (light.radiance != state.radiance) {
    light.radiance = state.radiance;
    session.setAreaLight(recording.lamp(), light);
  }
  session.setView(state.view);
}

}  // namespace lamplighter
