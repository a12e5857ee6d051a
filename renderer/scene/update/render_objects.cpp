#include "renderer/scene/update/render_objects.h"

#include <algorithm>
#include <utility>

#include "renderer/scene/light_shapes.h"

namespace lamplighter {

namespace {

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

// Calls f(vector with an entry for each vertex).
template <typename F>
void forEachAttribute(RenderScene& render, const F& f) {
  f(render.positions);
  f(render.normals);
  f(render.localPositions);
  f(render.localNormals);
  f(render.tangents);
  f(render.uv0);
  f(render.uv1);
  f(render.colors);
}

// Appends the primitive's vertices and indices, without places.
void allocate(RenderScene& render, ObjectSlot& slot, const Primitive& p) {
  slot.firstVertex = static_cast<uint32_t>(render.positions.size());
  slot.vertexCount = static_cast<uint32_t>(p.positions.size());
  slot.firstIndex = static_cast<uint32_t>(render.indices.size());
  slot.indexCount = static_cast<uint32_t>(p.indices.size());
  const size_t vertices = slot.firstVertex + p.positions.size();
  const size_t indices = slot.firstIndex + p.indices.size();
  if (vertices > render.positions.capacity() || indices > render.indices.capacity())
    reserveObjects(render, vertices, indices);
  render.positions.resize(vertices);
  render.localPositions.resize(vertices);
  render.localNormals.resize(vertices);
  render.normals.resize(vertices);
  render.tangents.resize(vertices, vec4(0.0f));
  render.indices.resize(indices);
  const auto extend = [&](auto& to, const auto& from, const auto& fill) {
    to.insert(to.end(), from.begin(), from.end());
    to.resize(vertices, fill);
  };
  extend(render.uv0, p.uv0, vec2(0.0f));
  extend(render.uv1, p.uv1, vec2(0.0f));
  extend(render.colors, p.colors, vec4(1.0f));
}

std::vector<mat4> matricesIn(float unit, const Scene& scene) {
  std::vector<mat4> world = worldMatrices(scene);
  const vec4 scale(vec3(1.0f / unit), 1.0f);
  for (mat4& m : world)
    for (int column = 0; column < 4; ++column) m[column] *= scale;
  return world;
}

}  // namespace

SceneState::SceneState(const Scene& scene, float unitOfLength)
    : unit(unitOfLength),
      world(matricesIn(unit, scene)),
      visible(visibleNodes(scene)),
      shining(shiningLights(scene).nodes),
      links(lightLinks(scene)) {}

std::vector<WantedObject> wantedObjects(const Scene& scene) {
  std::vector<WantedObject> wanted;
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (node.mesh != kNone) {
      const std::shared_ptr<const Mesh>& mesh = scene.meshes[static_cast<size_t>(node.mesh)];
      for (uint32_t p = 0; p < mesh->primitives.size(); ++p)
        if (!mesh->primitives[p].indices.empty()) wanted.push_back({i, mesh, p});
    }
    if (node.area) wanted.push_back({i, nullptr, 0});
  }
  return wanted;
}

void reserveObjects(RenderScene& render, size_t vertices, size_t indices) {
  const auto withMore = [](size_t count) { return count + count / 16 + 4096; };
  forEachAttribute(render, [&](auto& values) { values.reserve(withMore(vertices)); });
  render.indices.reserve(withMore(indices));
}

uint32_t appendObject(RenderScene& render, const Scene& scene, const WantedObject& wanted) {
  ObjectSlot& slot = render.slots.emplace_back();
  slot.node = scene.nodes[wanted.node].id;
  slot.mesh = wanted.mesh;
  slot.primitive = wanted.primitive;
  if (!wanted.mesh) slot.shape = scene.nodes[wanted.node].area->shape;
  RenderObject& o = render.objects.emplace_back();
  o.material = static_cast<int>(scene.materials.size());
  return static_cast<uint32_t>(render.objects.size() - 1);
}

void fillObject(RenderScene& render, const Scene& scene, const SceneState& state,
                const WantedObject& wanted, uint32_t object) {
  const Node& node = scene.nodes[wanted.node];
  ObjectSlot& slot = render.slots[object];
  if (slot.vertexCount == 0) {
    if (slot.mesh)
      allocate(render, slot, slot.mesh->primitives[slot.primitive]);
    else
      allocate(render, slot, tessellate(*node.area));
  }
  RenderObject& o = render.objects[object];
  o.node = node.id;
  o.isAreaLight = !slot.mesh;
  if (slot.mesh) o.kind = node.meshKind;
  o.firstVertex = slot.firstVertex;
  o.vertexCount = slot.vertexCount;
  o.firstIndex = slot.firstIndex;
  o.indexCount = slot.indexCount;
  o.link = state.links.ofLight[wanted.node];
  o.leftOutBy = state.links.leftOutBy[wanted.node];
  placeObject(render, node, state.world[wanted.node], object);
}

void placeObject(RenderScene& render, const Node& node, const mat4& world, uint32_t object) {
  ObjectSlot& slot = render.slots[object];
  RenderObject& o = render.objects[object];
  if (slot.mesh) {
    place(render, o, slot.mesh->primitives[slot.primitive], world);
  } else {
    place(render, o, tessellate(*node.area), world);
    slot.size = node.area->size;
  }
}

void emptyObject(RenderScene& render, uint32_t object) {
  const auto defaultMaterial = render.materials.size() - static_cast<size_t>(render.firstDark);
  render.objects[object] = RenderObject();
  render.objects[object].material = static_cast<int>(defaultMaterial);
}

}  // namespace lamplighter
