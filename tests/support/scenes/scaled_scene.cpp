#include "tests/support/scenes/scaled_scene.h"

#include "tests/support/render.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter::test {
namespace {

NodeId addPunctual(Scene& scene, const PunctualLight& light, const vec3& at, const quat& turn) {
  const NodeId id = addNode(scene, "light", kNoNode, at);
  scene.find(id)->local.rotation = turn;
  scene.find(id)->punctual = light;
  return id;
}

}  // namespace

Scene scaledScene(const Scene& scene, float factor) {
  Scene out = scene;
  for (auto& mesh : out.meshes) {
    Mesh scaled = *mesh;
    for (Primitive& p : scaled.primitives)
      for (vec3& v : p.positions) v *= factor;
    mesh = std::make_shared<const Mesh>(std::move(scaled));
  }
  for (Camera& camera : out.cameras) camera.znear *= factor, camera.zfar *= factor;
  for (Node& n : out.nodes) {
    n.local.translation *= factor;
    if (n.area) n.area->size *= factor;
    if (!n.punctual) continue;
    n.punctual->range *= factor;
    if (n.punctual->kind != PunctualKind::directional) n.punctual->intensity *= factor * factor;
  }
  return out;
}

View scaledView(const View& view, float factor) {
  View out = view;
  out.eye *= factor;
  out.znear *= factor;
  return out;
}

Scene roomOfAllLights() {
  Scene scene;
  const int grey = addMaterial(scene, vec3(0.6f)), red = addMaterial(scene, vec3(0.7f, 0.2f, 0.1f));
  addMesh(scene, squareMesh(6.0f, grey));
  addMesh(scene, boxMesh(vec3(6.0f, 3.0f, 0.25f), red), vec3(0.0f, 1.5f, -3.0f));
  addMesh(scene, boxMesh(vec3(0.25f, 3.0f, 6.0f), grey), vec3(-3.0f, 1.5f, 0.0f));
  addMesh(scene, boxMesh(vec3(6.0f, 0.25f, 4.0f), grey), vec3(0.0f, 3.0f, -1.0f));
  addMesh(scene, boxMesh(vec3(1.0f), grey), vec3(-0.75f, 0.5f, 0.0f));
  addMesh(scene, boxMesh(vec3(0.5f, 1.75f, 0.5f), red), vec3(1.25f, 0.875f, -1.5f));
  addMesh(scene, sphereMesh(0.375f, 8), vec3(0.75f, 0.375f, 1.0f));
  addRectangleLight(scene, vec3(0.0f, 2.75f, 0.0f), vec2(1.0f, 0.5f), vec3(6.0f, 5.0f, 4.0f));
  PunctualLight point;
  point.intensity = vec3(1.0f, 2.0f, 3.0f);
  addPunctual(scene, point, vec3(-2.0f, 1.5f, 1.0f), quat(1, 0, 0, 0));
  PunctualLight spot = point;
  spot.kind = PunctualKind::spot;
  spot.intensity = vec3(8.0f, 4.0f, 4.0f);
  spot.range = 12.0f;
  spot.outerCone = 0.5f;
  addPunctual(scene, spot, vec3(2.0f, 2.5f, 1.0f), glm::angleAxis(-1.25f, vec3(1, 0, 0)));
  PunctualLight sun = point;
  sun.kind = PunctualKind::directional;
  sun.intensity = vec3(2.0f);
  addPunctual(scene, sun, vec3(0.0f),
              glm::angleAxis(0.75f, vec3(0, 1, 0)) * glm::angleAxis(-0.75f, vec3(1, 0, 0)));
  return scene;
}

View viewOfRoom(int width, int height) {
  return lookAt(vec3(2.5f, 2.0f, 4.5f), vec3(-0.5f, 1.0f, -0.5f), width, height, 1.0f);
}

}  // namespace lamplighter::test
