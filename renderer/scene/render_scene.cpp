#include "renderer/scene/render_scene.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "renderer/scene/ies/ies_profile.h"
#include "renderer/scene/light_linking.h"
#include "renderer/scene/light_picture.h"
#include "renderer/scene/light_shapes.h"
#include "renderer/scene/reference_brightness.h"

namespace lamplighter {

namespace {

// Black while the light does not shine: its surface stays visible, dark and selectable.
Material emitterMaterial(const AreaLight& light, bool shines, int picture) {
  Material m;
  m.name = "area light";
  m.baseColor = vec4(0.0f, 0.0f, 0.0f, 1.0f);
  m.metallic = 0.0f;
  m.emissive = shines ? light.radiance : vec3(0.0f);
  m.emissiveTexture.texture = picture;
  // The surface's u points along the node's X, which is to the left when its front is seen.
  m.emissiveTexture.offset = vec2(1.0f, 0.0f);
  m.emissiveTexture.scale = vec2(-1.0f, 1.0f);
  return m;
}

// Textures of pictures on area lights, after those of the scene; by node: its texture index or
// kNone. Lights with the same picture share a texture.
struct Pictures {
  explicit Pictures(const Scene& scene) : ofNode(scene.nodes.size(), kNone) {
    std::map<const LightPicture*, int> known;
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
      const Node& n = scene.nodes[i];
      const LightPicture* picture = n.area ? shownPicture(*n.area) : nullptr;
      if (picture == nullptr) continue;
      const auto next = static_cast<int>(scene.textures.size() + shown.size());
      const auto [it, isNew] = known.emplace(picture, next);
      if (isNew) shown.push_back(picture);
      ofNode[i] = it->second;
    }
  }
  std::vector<const LightPicture*> shown;
  std::vector<int> ofNode;
};

Material darkCopy(const Material& material) {
  Material m = material;
  m.emissive = vec3(0.0f);
  return m;
}

// Writes the primitive's vertices in world space to the range of the object, and computes its
// bounds.
void place(RenderScene& render, RenderObject& object, const Primitive& p, const mat4& world) {
  const mat3 linear(world);
  const float determinant = glm::determinant(linear);
  // The cofactor matrix transforms normals correctly even if the scale is zero; its sign
  // compensates for mirroring.
  const mat3 cofactor(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                      glm::cross(linear[0], linear[1]));
  object.bounds = Bounds();
  object.world = world;
  const auto unit = [](const vec3& v, const vec3& fallback) {
    const float length = glm::length(v);
    return length > 0.0f ? v / length : fallback;
  };
  for (uint32_t i = 0; i < object.vertexCount; ++i) {
    const uint32_t to = object.firstVertex + i;
    render.localPositions[to] = p.positions[i];
    render.localNormals[to] = p.normals[i];
    render.positions[to] = vec3(world * vec4(p.positions[i], 1.0f));
    object.bounds.add(render.positions[to]);
    const vec3 n = cofactor * p.normals[i];
    render.normals[to] = unit(determinant < 0.0f ? -n : n, vec3(0, 1, 0));
    if (!p.tangents.empty()) {
      const vec3 t = unit(linear * vec3(p.tangents[i]), vec3(1, 0, 0));
      render.tangents[to] = vec4(t, determinant < 0.0f ? -p.tangents[i].w : p.tangents[i].w);
    }
  }
  // Mirroring reverses the winding: swap two vertices so that the front stays the front.
  for (uint32_t i = 0; i < object.indexCount; i += 3) {
    uint32_t* out = &render.indices[object.firstIndex + i];
    out[0] = object.firstVertex + p.indices[i];
    out[1] = object.firstVertex + p.indices[i + 1];
    out[2] = object.firstVertex + p.indices[i + 2];
    if (determinant < 0.0f) std::swap(out[1], out[2]);
  }
}

void append(RenderScene& render, NodeId node, const Primitive& p, const mat4& world, int material,
            bool isAreaLight) {
  RenderObject o;
  o.node = node;
  o.material = material;
  o.isAreaLight = isAreaLight;
  o.firstVertex = static_cast<uint32_t>(render.positions.size());
  o.vertexCount = static_cast<uint32_t>(p.positions.size());
  o.firstIndex = static_cast<uint32_t>(render.indices.size());
  o.indexCount = static_cast<uint32_t>(p.indices.size());
  const size_t vertices = o.firstVertex + p.positions.size();
  render.positions.resize(vertices);
  render.localPositions.resize(vertices);
  render.localNormals.resize(vertices);
  render.normals.resize(vertices);
  render.tangents.resize(vertices, vec4(0.0f));
  render.indices.resize(o.firstIndex + p.indices.size());
  const auto extend = [&](auto& to, const auto& from, const auto& fill) {
    to.insert(to.end(), from.begin(), from.end());
    to.resize(vertices, fill);
  };
  extend(render.uv0, p.uv0, vec2(0.0f));
  extend(render.uv1, p.uv1, vec2(0.0f));
  extend(render.colors, p.colors, vec4(1.0f));
  place(render, o, p, world);
  render.objects.push_back(o);
}

// World matrices of the nodes that give positions in the unit of the scene.
std::vector<mat4> matricesInUnits(const RenderScene& render, const Scene& scene) {
  std::vector<mat4> world = worldMatrices(scene);
  const vec4 scale(vec3(1.0f / render.unit), 1.0f);
  for (mat4& m : world)
    for (int column = 0; column < 4; ++column) m[column] *= scale;
  return world;
}

// `world`: of matricesInUnits().
RenderPunctual placed(const RenderScene& render, const Node& node, const mat4& world, bool shines) {
  RenderPunctual r;
  r.node = node.id;
  r.light = *node.punctual;
  r.position = vec3(world[3]);
  const vec3 aim = mat3(world) * vec3(0, 0, -1);
  const float length = glm::length(aim);
  if (length > 0.0f) r.direction = aim / length;
  if (r.light.profile) r.light.intensity *= r.light.profile->atTilt(r.direction);
  if (r.light.kind != PunctualKind::directional) r.light.intensity /= render.unit * render.unit;
  r.light.range /= render.unit;
  r.nominal = r.light.intensity;
  if (!shines) r.light.intensity = vec3(0.0f);
  // Scale, shear and mirroring only affect the direction of X.
  const vec3 z = -r.direction, x = vec3(world[0]) - glm::dot(vec3(world[0]), z) * z;
  const vec3 right = glm::length(x) > 0.0f ? glm::normalize(x) : Frame(z).tangent;
  r.axes = mat3(right, glm::cross(z, right), z);
  return r;
}

// Index into RenderScene::materials.
int materialOf(const RenderScene& render, const Scene& scene, const Primitive& p, bool shines) {
  if (p.material == kNone) return static_cast<int>(scene.materials.size());
  const bool isDark = !shines && scene.materials[static_cast<size_t>(p.material)].emits();
  return p.material + (isDark ? render.firstDark : 0);
}

void rebuild(RenderScene& render, const Scene& scene) {
  const float unit = render.unit;
  render = RenderScene();
  render.unit = unit;
  render.materials = scene.materials;
  render.materials.emplace_back().metallic = 0.0f;  // the default material
  render.firstDark = static_cast<int>(
      render.materials.size() +
      std::ranges::count_if(scene.nodes, [](const Node& n) { return n.area.has_value(); }));
  render.textures = scene.textures;
  const Pictures pictures(scene);
  for (const LightPicture* p : pictures.shown)
    render.textures.push_back({p->file, p->image, Wrap::clamp, Wrap::clamp, false, false});
  const std::vector<mat4> world = matricesInUnits(render, scene);
  const std::vector<bool> visible = visibleNodes(scene);
  const std::vector<bool> shining = shiningLights(scene).nodes;
  const LightLinks links = lightLinks(scene);
  render.hasLinks = links.count > 0;
  render.skyLink = links.ofSky;
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (node.area)
      render.materials.push_back(emitterMaterial(*node.area, shining[i], pictures.ofNode[i]));
    if (!visible[i]) continue;
    const size_t firstObject = render.objects.size();
    if (node.mesh != kNone) {
      for (const Primitive& p : scene.meshes[node.mesh]->primitives) {
        if (p.indices.empty()) continue;
        append(render, node.id, p, world[i], materialOf(render, scene, p, shining[i]), false);
        render.objects.back().kind = node.meshKind;
      }
    }
    if (node.area) {
      append(render, node.id, tessellate(*node.area), world[i],
             static_cast<int>(render.materials.size()) - 1, true);
    }
    for (size_t o = firstObject; o < render.objects.size(); ++o) {
      render.objects[o].link = links.ofLight[i];
      render.objects[o].leftOutBy = links.leftOutBy[i];
    }
    if (node.punctual) {
      render.punctuals.push_back(placed(render, node, world[i], shining[i]));
      render.punctuals.back().link = links.ofLight[i];
    }
  }
  for (const Material& m : scene.materials) render.materials.push_back(darkCopy(m));
  for (const Material& m : render.materials) render.nominalEmission.push_back(m.emissive);
  size_t ofAreaLight = scene.materials.size() + 1;
  for (const Node& node : scene.nodes)
    if (node.area) render.nominalEmission[ofAreaLight++] = node.area->radiance;
  for (size_t i = 0; i < scene.materials.size(); ++i)
    render.nominalEmission[static_cast<size_t>(render.firstDark) + i] = scene.materials[i].emissive;
}

void findBounds(RenderScene& render) {
  render.bounds = Bounds();
  for (const RenderObject& o : render.objects) render.bounds.add(o.bounds);
}

// Updates moved objects in place. Objects are in the order of nodes and primitives, as rebuild()
// created them.
void moveObjects(RenderScene& render, const Scene& scene, const SceneChanges& changes,
                 RenderSceneChanges& out) {
  const std::vector<mat4> world = matricesInUnits(render, scene);
  const std::vector<bool> shining = shiningLights(scene).nodes;
  const auto hasMoved = [&](NodeId id) {
    return std::binary_search(changes.moved.begin(), changes.moved.end(), id);
  };
  uint32_t object = 0;
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    const bool moved = hasMoved(node.id);
    size_t primitive = 0;
    for (; object < render.objects.size() && render.objects[object].node == node.id; ++object) {
      RenderObject& o = render.objects[object];
      const Primitive* p = nullptr;
      if (!o.isAreaLight) {
        const auto& primitives = scene.meshes[node.mesh]->primitives;
        while (primitives[primitive].indices.empty()) ++primitive;
        p = &primitives[primitive++];
      }
      if (p != nullptr) {
        const int material = materialOf(render, scene, *p, shining[i]);
        if (o.material != material) out.switchedObjects.push_back(object);
        o.material = material;
      }
      if (!moved) continue;
      out.movedObjects.push_back(object);
      out.movedBounds.push_back(o.bounds);
      place(render, o, o.isAreaLight ? tessellate(*node.area) : *p, world[i]);
    }
  }
  for (RenderPunctual& p : render.punctuals) {
    const bool moved = hasMoved(p.node);
    const bool changed = std::binary_search(changes.lights.begin(), changes.lights.end(), p.node);
    if (!moved && !changed) continue;
    const auto it = std::find_if(scene.nodes.begin(), scene.nodes.end(),
                                 [&](const Node& n) { return n.id == p.node; });
    const auto index = static_cast<size_t>(it - scene.nodes.begin());
    RenderPunctual before = std::move(p);
    p = placed(render, *it, world[index], shining[index]);
    p.link = before.link;  // a different link would be a change of structure
    out.gains |= before.light.intensity != p.light.intensity;
    out.references |= referenceBrightness(before.nominal) != referenceBrightness(p.nominal);
    before.light.intensity = p.light.intensity;
    before.nominal = p.nominal;
    out.lights |= !(before == p);
  }
}

// Replaces a material, and adds to `out` what changed: of an area light's surface, which reflects
// nothing, and of a material that emits before and after, perhaps only the emission. `nominal`: the
// emission while its light is on.
void takeMaterial(RenderScene& render, size_t index, Material now, const vec3& nominal,
                  bool isOfAreaLight, RenderSceneChanges& out) {
  vec3& known = render.nominalEmission[index];
  out.references |= referenceBrightness(known) != referenceBrightness(nominal);
  known = nominal;
  Material& material = render.materials[index];
  if (material == now) return;
  std::swap(material, now);
  const bool emitted = now.emits();
  now.emissive = material.emissive;
  if ((isOfAreaLight || emitted == material.emits()) && now == material)
    out.emissions.push_back(static_cast<int>(index));
  else
    out.materials = true;
}

// Updates the materials derived from the scene: of area lights, and dark copies.
void takeEmitters(RenderScene& render, const Scene& scene, RenderSceneChanges& out) {
  size_t next = scene.materials.size() + 1;
  const std::vector<bool> shining = shiningLights(scene).nodes;
  const Pictures pictures(scene);
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    if (scene.nodes[i].area)
      takeMaterial(render, next++,
                   emitterMaterial(*scene.nodes[i].area, shining[i], pictures.ofNode[i]),
                   scene.nodes[i].area->radiance, true, out);
  }
  for (const Material& m : scene.materials)
    takeMaterial(render, next++, darkCopy(m), m.emissive, false, out);
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

void RenderSceneChanges::merge(const RenderSceneChanges& later) {
  rebuilt |= later.rebuilt;
  materials |= later.materials;
  lights |= later.lights;
  sky |= later.sky;
  gains |= later.gains;
  references |= later.references;
  if (rebuilt) {
    movedObjects.clear();
    movedBounds.clear();
    emissions.clear();
    switchedObjects.clear();
    return;
  }
  std::vector<uint32_t> switched;
  std::ranges::set_union(switchedObjects, later.switchedObjects, std::back_inserter(switched));
  switchedObjects = std::move(switched);
  std::vector<int> both;
  std::set_union(emissions.begin(), emissions.end(), later.emissions.begin(), later.emissions.end(),
                 std::back_inserter(both));
  emissions = std::move(both);
  for (size_t i = 0; i < later.movedObjects.size(); ++i) {
    const uint32_t object = later.movedObjects[i];
    // An object that moved before keeps its first bounds.
    if (std::find(movedObjects.begin(), movedObjects.end(), object) != movedObjects.end()) continue;
    movedObjects.push_back(object);
    movedBounds.push_back(later.movedBounds[i]);
  }
}

RenderSceneChanges setUnit(RenderScene& render, const Scene& scene, float unit) {
  render.unit = unit;
  return update(render, scene, SceneChanges::all());
}

RenderSceneChanges update(RenderScene& render, const Scene& scene, const SceneChanges& changes) {
  RenderSceneChanges out;
  if (changes.none()) return out;
  if (changes.everything || changes.structure) {
    rebuild(render, scene);
    out.rebuilt = true;
  } else {
    if (!changes.moved.empty() || !changes.lights.empty()) moveObjects(render, scene, changes, out);
    for (const int i : changes.materials)
      takeMaterial(render, static_cast<size_t>(i), scene.materials[i], scene.materials[i].emissive,
                   false, out);
    takeEmitters(render, scene, out);
  }
  takeSky(render, scene, out);
  findBounds(render);
  return out;
}

}  // namespace lamplighter
