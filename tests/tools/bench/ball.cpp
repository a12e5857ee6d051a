#include "tests/tools/bench/ball.h"

#include "renderer/scene/light_shapes.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

NodeId addBall(Scene& scene) {
  RenderScene level;
  update(level, scene, SceneChanges::all());
  AreaLight ball;
  ball.shape = AreaShape::sphere;
  ball.size = vec2(1.0f);
  auto mesh = std::make_shared<Mesh>();
  mesh->primitives.push_back(tessellate(ball));
  Node node;
  node.id = scene.nextId++;
  node.name = "ball";
  node.mesh = static_cast<int>(scene.meshes.size());
  node.local.translation = level.bounds.centre();
  scene.meshes.push_back(mesh);
  scene.nodes.push_back(node);
  return node.id;
}

}  // namespace lamplighter
