#include "renderer/backends/gl/many_lights/gl_patches.h"

#include <algorithm>
#include <bit>

#include "renderer/base/error.h"
#include "renderer/gl/storage_buffer.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/patches.h"

namespace lamplighter::gl {
namespace {

Buffer makeBuffer(size_t count, size_t size) {
  Buffer buffer = Buffer::make();
  glNamedBufferStorage(buffer.name(), static_cast<GLsizeiptr>(std::max<size_t>(count, 1) * size),
                       nullptr, GL_DYNAMIC_STORAGE_BIT);
  return buffer;
}

}  // namespace

template <typename T>
void GlPatches::write(const Buffer& buffer, uint32_t first, std::span<const T> values) {
  if (values.empty()) return;
  uploaded_ += values.size_bytes();
  glNamedBufferSubData(buffer.name(), static_cast<GLintptr>(first * sizeof(T)),
                       static_cast<GLsizeiptr>(values.size_bytes()), values.data());
}

GlPatches::Sizes GlPatches::sizesOf(const RenderScene& scene, const PatchLights& lights,
                                    uint32_t object) {
  const ObjectPatches& patches = lights.patches(object);
  Sizes n;
  n.triangles = scene.objects[object].triangleCount();
  n.nodes = static_cast<uint32_t>(patches.patches.size());
  n.charts = static_cast<uint32_t>(patches.charts.size());
  if (lights.prt() != nullptr && lights.prt()->hasTransfer(object))
    n.vertices = scene.objects[object].vertexCount;
  if (lights.maps() == nullptr) return n;
  for (size_t i = 0; i < patches.patches.size(); ++i)
    n.tiles += lights.maps()->tile(object, static_cast<int>(i)) != nullptr;
  n.texels = static_cast<uint32_t>(lights.maps()->texels(object).size());
  return n;
}

// Whether the object has the patches, the tiles and the kind of light that were uploaded.
bool GlPatches::hasSameTrees(const PatchLights& lights, uint32_t object) const {
  const Object& o = objects_[object];
  const bool isLit = lights.prt() != nullptr && lights.prt()->hasTransfer(object);
  return isLit == (o.size.vertices != 0) && o.patches == lights.patches(object).revision &&
         (!hasMaps_ || o.tiling == lights.maps()->tiling(object));
}

void GlPatches::update(const RenderScene& scene, const PatchLights& lights) {
  const bool hasMaps = lights.maps() != nullptr;
  bool resized = objects_.size() != scene.objects.size() || hasMaps_ != hasMaps;
  std::vector<uint32_t> changed;
  for (uint32_t i = 0; i < scene.objects.size() && !resized; ++i) {
    if (hasSameTrees(lights, i)) continue;
    changed.push_back(i);
    resized = sizesOf(scene, lights, i) != objects_[i].size;
  }
  if (resized) {
    hasMaps_ = hasMaps;
    objects_.assign(scene.objects.size(), {});
    total_ = {};
    changed.clear();
    for (uint32_t i = 0; i < objects_.size(); ++i) {
      Object& o = objects_[i];
      o.first = total_;
      o.first.triangles = scene.objects[i].firstIndex / 3;
      o.size = sizesOf(scene, lights, i);
      total_.triangles = std::max(total_.triangles, o.first.triangles + o.size.triangles);
      total_.nodes += o.size.nodes;
      total_.charts += o.size.charts;
      total_.tiles += o.size.tiles;
      total_.texels += o.size.texels;
      total_.vertices += o.size.vertices;
      changed.push_back(i);
    }
    allocate();
  }
  for (const uint32_t i : changed) upload(scene, lights, i);
  for (uint32_t i = 0; hasMaps && i < objects_.size(); ++i)
    if (objects_[i].maps != lights.maps()->revision(i)) uploadTexels(*lights.maps(), i);
  for (uint32_t i = 0; i < objects_.size(); ++i) {
    Object& o = objects_[i];
    if (o.size.vertices == 0 || o.light == lights.prt()->revision(i)) continue;
    write<vec3>(vertexLight_, o.first.vertices, lights.prt()->irradiance(i));
    o.light = lights.prt()->revision(i);
  }
}

uint64_t GlPatches::mostTexels() { return mostStorageBytes() / sizeof(vec4); }

void GlPatches::allocate() {
  const uint64_t texels = uint64_t{total_.texels} * sizeof(vec4);
  const uint64_t light = uint64_t{total_.vertices} * sizeof(vec3);
  if (light > mostStorageBytes()) {
    throw InputError("many_lights",
                     std::to_string(total_.vertices) +
                         " vertices lit by transfer exceed the limit of this driver",
                     "lower prt_memory, switch prt off or use --backend cpu");
  }
  roots_ = makeBuffer(total_.triangles, sizeof(uint32_t));
  patches_ = makeBuffer(total_.nodes, sizeof(shared::PatchNode));
  charts_ = makeBuffer(total_.charts, sizeof(shared::PatchChart));
  tiles_ = makeBuffer(total_.tiles, sizeof(shared::PatchTile));
  texels_ = makeBuffer(total_.texels, sizeof(vec4));
  vertexLight_ = makeBuffer(total_.vertices, sizeof(vec3));
  bytes_ = light + total_.triangles * sizeof(uint32_t) + total_.nodes * sizeof(shared::PatchNode) +
           total_.charts * sizeof(shared::PatchChart) + total_.tiles * sizeof(shared::PatchTile) +
           texels;
}

void GlPatches::upload(const RenderScene& scene, const PatchLights& lights, uint32_t object) {
  const ObjectPatches& patches = lights.patches(object);
  const Sizes& first = objects_[object].first;
  std::vector<uint32_t> roots;
  for (const int root : patches.patchOfTriangle)
    roots.push_back(first.nodes + static_cast<uint32_t>(root));

  std::vector<shared::PatchNode> nodes;
  std::vector<shared::PatchTile> tiles;
  for (size_t i = 0; i < patches.patches.size(); ++i) {
    const Patch& p = patches.patches[i];
    glm::uvec4& branch = nodes.emplace_back(shared::PatchNode{glm::uvec4(0)}).branch;
    if (p.chart != kNone) branch.y = 1 + first.charts + static_cast<uint32_t>(p.chart);
    if (!p.isLeaf()) {
      branch.x = first.nodes + static_cast<uint32_t>(p.firstChild);
      branch.z = static_cast<uint32_t>(p.axis);
      branch.w = std::bit_cast<uint32_t>(0.5f * (p.min[p.axis] + p.max[p.axis]));
      continue;
    }
    if (objects_[object].size.vertices != 0 && p.chart == kNone) {
      branch.z = 1;
      branch.w = first.vertices - scene.objects[object].firstVertex;  // modulo 2³²
    }
    if (!hasMaps_) continue;
    const LightMapTile* tile = lights.maps()->tile(object, static_cast<int>(i));
    if (tile == nullptr) continue;
    branch.z = 1 + first.tiles + static_cast<uint32_t>(tiles.size());
    const vec2 steps(static_cast<float>(tile->columns - 1), static_cast<float>(tile->rows - 1));
    const vec2 size = glm::max(p.max - p.min, vec2(1e-20f));
    tiles.push_back({vec4(p.min, steps / size),
                     glm::uvec4(first.texels + tile->first, tile->columns, tile->rows, 0)});
  }
  std::vector<shared::PatchChart> charts;
  for (const Chart& c : patches.charts)
    charts.push_back({vec4(c.origin, 0.0f), vec4(c.tangent, 0.0f), vec4(c.bitangent, 0.0f)});

  write<uint32_t>(roots_, first.triangles, roots);
  write<shared::PatchNode>(patches_, first.nodes, nodes);
  write<shared::PatchChart>(charts_, first.charts, charts);
  write<shared::PatchTile>(tiles_, first.tiles, tiles);
  Object& o = objects_[object];
  o.patches = patches.revision;
  o.tiling = hasMaps_ ? lights.maps()->tiling(object) : Revision();
  o.maps = Revision();
  o.writes.clear();
}

// Uploads the texels of tiles that were written since the last upload.
void GlPatches::uploadTexels(const LightMaps& maps, uint32_t object) {
  Object& o = objects_[object];
  const std::span<const LightMapTile> tiles = maps.tiles(object);
  const std::span<const uint32_t> writes = maps.writes(object);
  const std::span<const vec4> texels = maps.texels(object);
  // Without earlier writes all texels are new, also of tiles that were never written.
  const bool isNew = o.writes.size() != tiles.size();
  const auto isWritten = [&](size_t t) { return isNew || o.writes[t] != writes[t]; };
  for (size_t t = 0, next; t < tiles.size(); t = next) {
    next = t + 1;
    if (!isWritten(t)) continue;
    while (next < tiles.size() && isWritten(next)) ++next;
    const size_t begin = tiles[t].first;
    const size_t end = next < tiles.size() ? size_t{tiles[next].first} : texels.size();
    write<vec4>(texels_, o.first.texels + static_cast<uint32_t>(begin),
                texels.subspan(begin, end - begin));
  }
  o.writes.assign(writes.begin(), writes.end());
  o.maps = maps.revision(object);
}

void GlPatches::bind() const {
  const auto bind = [](int binding, const Buffer& buffer) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(binding), buffer.name());
  };
  bind(shared::kRootBuffer, roots_);
  bind(shared::kPatchBuffer, patches_);
  bind(shared::kChartBuffer, charts_);
  bind(shared::kTileBuffer, tiles_);
  bind(shared::kTexelBuffer, texels_);
  bind(shared::kVertexLightBuffer, vertexLight_);
}

}  // namespace lamplighter::gl
