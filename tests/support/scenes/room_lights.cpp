#include "tests/support/scenes/room_lights.h"

namespace lamplighter::test {

std::vector<shared::Vpl> lightsOf(const RenderScene& scene, const VplCounts& counts) {
  std::vector<shared::Vpl> lights;
  for (const SceneVpl& v : generateVpls(scene, RayCaster(scene), LightSet(scene), counts).vpls)
    lights.push_back(v.vpl);
  return lights;
}

std::vector<shared::Vpl> lightsOf(const RenderScene& scene, int count) {
  return lightsOf(scene, {count, 0.3f, 3, 1});
}

}  // namespace lamplighter::test
