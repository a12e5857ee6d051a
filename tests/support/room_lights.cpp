#include "tests/support/room_lights.h"

#include "renderer/sampling/vpl_set.h"

namespace lamplighter::test {

std::vector<shared::Vpl> lightsOf(const RenderScene& scene, int count) {
  std::vector<shared::Vpl> lights;
  for (const SceneVpl& v :
       generateVpls(scene, RayCaster(scene), LightSet(scene), {count, 0.3f, 3, 1}).vpls)
    lights.push_back(v.vpl);
  return lights;
}

}  // namespace lamplighter::test
