#include "tests/support/scenes/random_boxes.h"

#include <random>

#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter::test {
namespace {

// Uniform numbers from the bits of the generator, equal with every standard library.
class Random {
 public:
  explicit Random(uint32_t seed) : engine_(seed) {}
  float in(float from, float to) {
    return from + (to - from) * static_cast<float>(engine_() >> 8) * 0x1p-24f;
  }
  vec3 point(const vec3& from, const vec3& to) {
    const float x = in(from.x, to.x), y = in(from.y, to.y), z = in(from.z, to.z);
    return {x, y, z};
  }
  vec3 direction() {
    for (;;) {
      const vec3 v = point(vec3(-1.0f), vec3(1.0f));
      const float l = glm::length(v);
      if (l > 0.1f && l <= 1.0f) return v / l;
    }
  }

 private:
  std::mt19937 engine_;
};

}  // namespace

Scene randomBoxes(int count, uint32_t seed) {
  Random random(seed);
  Scene scene;
  const int grey = addMaterial(scene, vec3(0.7f));
  addMesh(scene, squareMesh(8.0f, grey));
  addMesh(scene, boxMesh(vec3(8, 4, 0.2f), grey), vec3(0, 2, -4.1f));
  addMesh(scene, boxMesh(vec3(0.2f, 4, 8), grey), vec3(-4.1f, 2, 0));
  for (int i = 0; i < count; ++i) {
    const int material = addMaterial(scene, random.point(vec3(0.2f), vec3(0.9f)));
    const vec3 size = random.point(vec3(0.2f), vec3(1.2f));
    const vec3 at = random.point(vec3(-3, 0.2f, -3), vec3(3, 2.5f, 3));
    const NodeId id = addMesh(scene, boxMesh(size, material), at);
    const vec3 axis = random.direction();
    scene.find(id)->local.rotation = glm::angleAxis(random.in(0.0f, 3.0f), axis);
  }
  return scene;
}

std::vector<shared::Vpl> randomVpls(int count, uint32_t seed) {
  Random random(seed);
  std::vector<shared::Vpl> vpls;
  for (int i = 0; i < count; ++i) {
    const vec3 at = random.point(vec3(-3, 1, -3), vec3(3, 3.5f, 3));
    const vec3 axis = random.direction();
    shared::Vpl vpl = makeVpl(at, axis, shared::kVplCosine, random.in(0.0f, 3.0f));
    const vec3 color = random.point(vec3(0.2f), vec3(1.0f));
    vpl.intensity = color;
    vpl.slot = static_cast<int>(i);
    vpls.push_back(vpl);
  }
  return vpls;
}

}  // namespace lamplighter::test
