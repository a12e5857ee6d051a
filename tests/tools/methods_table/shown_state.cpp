#include "tests/tools/methods_table/shown_state.h"

namespace lamplighter {

void show(Session& session, const test::LevelRecording& recording,
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
