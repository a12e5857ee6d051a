// update() of render_scene.h.
#include <algorithm>
#include <utility>

#include "renderer/scene/ies/ies_profile.h"
#include "renderer/scene/reference_brightness.h"
#include "renderer/scene/render_scene.h"
#include "renderer/scene/update/render_materials.h"
#include "renderer/scene/update/render_objects.h"
#include "renderer/scene/update/render_structure.h"

namespace lamplighter {

namespace {

// `world` gives positions in the unit [m].
RenderPunctual placed(const Node& node, const mat4& world, float unit, bool shines) {
  RenderPunctual r;
  r.node = node.id;
  r.light = *node.punctual;
  r.position = vec3(world[3]);
  const vec3 aim = mat3(world) * vec3(0, 0, -1);
  const float length = glm::length(aim);
  if (length > 0.0f) r.direction = aim / length;
  if (r.light.profile) r.light.intensity *= r.light.profile->atTilt(r.direction);
  if (r.light.kind != PunctualKind::directional) r.light.intensity /= unit * unit;
  r.light.range /= unit;
  r.nominal = r.light.intensity;
  if (!shines) r.light.intensity = vec3(0.0f);
  // Scale, shear and mirroring only affect the direction of X.
  const vec3 z = -r.direction, x = vec3(world[0]) - glm::dot(vec3(world[0]), z) * z;
  const vec3 right = glm::length(x) > 0.0f ? glm::normalize(x) : Frame(z).tangent;
  r.axes = mat3(right, glm::cross(z, right), z);
  return r;
}

std::vector<RenderPunctual> punctualsOf(const Scene& scene, const SceneState& state) {
  std::vector<RenderPunctual> punctuals;
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    if (!scene.nodes[i].punctual || !state.visible[i]) continue;
    punctuals.push_back(placed(scene.nodes[i], state.world[i], state.unit, state.shining[i]));
    punctuals.back().link = state.links.ofLight[i];
  }
  return punctuals;
}

void takePunctuals(RenderScene& render, std::vector<RenderPunctual> now, RenderSceneChanges& out) {
  std::vector<RenderPunctual> before = std::exchange(render.punctuals, std::move(now));
  if (!std::ranges::equal(before, render.punctuals, {}, &RenderPunctual::node,
                          &RenderPunctual::node)) {
    out.lights = true;
    return;
  }
  for (size_t i = 0; i < before.size(); ++i) {
    const RenderPunctual& p = render.punctuals[i];
    out.gains |= before[i].light.intensity != p.light.intensity;
    out.references |= referenceBrightness(before[i].nominal) != referenceBrightness(p.nominal);
    before[i].light.intensity = p.light.intensity;
    before[i].nominal = p.nominal;
    out.lights |= !(before[i] == p);
  }
}

void rebuild(RenderScene& render, const Scene& scene, const SceneState& state) {
  render = RenderScene();
  render.unit = state.unit;
  RenderMaterials materials(scene, state.shining);
  render.materials = std::move(materials.materials);
  render.nominalEmission = std::move(materials.nominalEmission);
  render.textures = std::move(materials.textures);
  render.firstDark = materials.firstDark;
  render.hasLinks = state.links.count > 0;
  render.skyLink = state.links.ofSky;
  const std::vector<WantedObject> wanted = wantedObjects(scene);
  size_t vertices = 0, indices = 0;
  for (const WantedObject& w : wanted) {
    if (!w.mesh || !state.visible[w.node]) continue;
    vertices += w.mesh->primitives[w.primitive].positions.size();
    indices += w.mesh->primitives[w.primitive].indices.size();
  }
  reserveObjects(render, vertices, indices);
  for (const WantedObject& w : wanted) {
    const uint32_t object = appendObject(render, scene, w);
    if (!state.visible[w.node]) continue;
    fillObject(render, scene, state, w, object);
    render.objects[object].material = w.mesh ? materialOf(scene, w.mesh->primitives[w.primitive],
                                                          state.shining[w.node], render.firstDark)
                                             : materials.ofAreaLight[w.node];
  }
  render.punctuals = punctualsOf(scene, state);
}

void findBounds(RenderScene& render) {
  render.bounds = Bounds();
  for (const RenderObject& o : render.objects) render.bounds.add(o.bounds);
}

// Updates moved objects in place, and those whose light was switched.
void moveObjects(RenderScene& render, const Scene& scene, const SceneState& state,
                 const SceneChanges& changes, RenderSceneChanges& out) {
  size_t i = 0;  // objects are in the order of nodes
  for (uint32_t object = 0; object < render.objects.size(); ++object) {
    RenderObject& o = render.objects[object];
    if (o.isEmpty()) continue;
    while (scene.nodes[i].id != o.node) ++i;
    const Node& node = scene.nodes[i];
    const ObjectSlot& slot = render.slots[object];
    if (slot.mesh) {
      const int material = materialOf(scene, slot.mesh->primitives[slot.primitive],
                                      state.shining[i], render.firstDark);
      if (o.material != material) out.switchedObjects.push_back(object);
      o.material = material;
    }
    if (!std::ranges::binary_search(changes.moved, node.id)) continue;
    out.movedObjects.push_back(object);
    out.movedBounds.push_back(o.bounds);
    placeObject(render, node, state.world[i], object);
  }
}

void takeSky(RenderScene& render, const Scene& scene, RenderSceneChanges& out) {
  const Sky sky = shiningLights(scene).sky ? scene.sky : Sky();
  out.gains |= render.sky != sky;
  out.sky = out.rebuilt || render.nominalSky.withFactor(1.0f) != scene.sky.withFactor(1.0f);
  out.references |=
      referenceBrightness(render.nominalSky.factor()) != referenceBrightness(scene.sky.factor());
  render.sky = sky;
  render.nominalSky = scene.sky;
}

}  // namespace

RenderSceneChanges update(RenderScene& render, const Scene& scene, const SceneChanges& changes) {
  RenderSceneChanges out;
  if (changes.none()) return out;
  const SceneState state(scene, render.unit);
  if (changes.everything || (changes.structure && !takeStructure(render, scene, state, out))) {
    rebuild(render, scene, state);
    out.rebuilt = true;
  } else {
    if (!changes.structure) {
      if (!changes.moved.empty() || !changes.lights.empty())
        moveObjects(render, scene, state, changes, out);
      takeMaterials(render, RenderMaterials(scene, state.shining), out);
    }
    takePunctuals(render, punctualsOf(scene, state), out);
  }
  takeSky(render, scene, out);
  findBounds(render);
  return out;
}

}  // namespace lamplighter
