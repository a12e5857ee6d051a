#include "renderer/backends/gl/gl_scene.h"

#include <algorithm>
#include <cstring>
#include <tuple>

#include "renderer/base/error.h"
#include "renderer/gl/storage_buffer.h"
#include "shaders/shared/bindings.h"

namespace lamplighter::gl {
namespace {

// Room for objects that come later.
size_t withMore(size_t count) { return count + count / 16 + 1024; }

template <typename T>
Buffer makeRoom(size_t count, uint64_t& bytes) {
  Buffer buffer = Buffer::make();
  const auto size = static_cast<GLsizeiptr>(count * sizeof(T));
  glNamedBufferStorage(buffer.name(), size, nullptr, GL_DYNAMIC_STORAGE_BIT);
  bytes += static_cast<uint64_t>(size);
  return buffer;
}

// Allocates a buffer of the vector's size; never empty, because a buffer without storage cannot be
// bound.
template <typename T>
Buffer upload(const std::vector<T>& values, uint64_t& bytes) {
  static const T kNothing[1]{};
  const auto size = static_cast<GLsizeiptr>(std::max<size_t>(values.size(), 1) * sizeof(T));
  Buffer buffer = Buffer::make();
  glNamedBufferStorage(buffer.name(), size, values.empty() ? kNothing : values.data(),
                       GL_DYNAMIC_STORAGE_BIT);
  bytes += static_cast<uint64_t>(size);
  return buffer;
}

template <typename T>
void uploadRange(const Buffer& buffer, const std::vector<T>& values, uint32_t first,
                 uint32_t count) {
  glNamedBufferSubData(buffer.name(), static_cast<GLintptr>(first * sizeof(T)),
                       static_cast<GLsizeiptr>(count * sizeof(T)), values.data() + first);
}

void uploadLeftOut(const Buffer& buffer, const RenderObject& o) {
  if (o.isEmpty()) return;
  const std::vector<uint32_t> values(o.triangleCount(), o.leftOutBy);
  glNamedBufferSubData(buffer.name(), static_cast<GLintptr>(o.firstIndex / 3 * sizeof(uint32_t)),
                       static_cast<GLsizeiptr>(values.size() * sizeof(uint32_t)), values.data());
}

shared::TextureLookup lookup(const TextureRef& ref) {
  if (ref.texture == kNone) return {vec4(0.0f), vec4(0.0f)};
  // Scale, then rotate counter-clockwise about the origin, then offset.
  const float c = std::cos(ref.rotation), s = std::sin(ref.rotation);
  return {vec4(c * ref.scale.x, s * ref.scale.y, ref.offset.x, ref.texCoord == 1 ? 1.0f : 0.0f),
          vec4(-s * ref.scale.x, c * ref.scale.y, ref.offset.y, 1.0f)};
}

bool isTextured(const Material& m) {
  return m.baseColorTexture.texture != kNone || m.normalTexture.texture != kNone ||
         m.metallicRoughnessTexture.texture != kNone ||
         (m.emissiveTexture.texture != kNone && m.emits());
}

}  // namespace

shared::SurfaceMaterial surfaceMaterial(const Material& m) {
  shared::SurfaceMaterial out{};
  out.baseColor = m.baseColor;
  out.emissive = vec4(m.emits() ? m.emissive : vec3(0.0f), m.doubleSided ? 1.0f : 0.0f);
  out.options = vec4(m.alphaCutoff, m.normalScale, m.metallic, m.roughness);
  out.baseColorLookup = lookup(m.baseColorTexture);
  out.normalLookup = lookup(m.normalTexture);
  out.emissiveLookup = lookup(m.emissiveTexture);
  out.glossLookup = lookup(m.metallicRoughnessTexture);
  return out;
}

GlScene::GlScene() : vertexArray_(VertexArray::make()) {
  const GLuint array = vertexArray_.name();
  const auto attribute = [&](int index, int components) {
    const auto i = static_cast<GLuint>(index);
    glEnableVertexArrayAttrib(array, i);
    glVertexArrayAttribFormat(array, i, components, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(array, i, i);
  };
  attribute(shared::kPositionAttribute, 3);
  attribute(shared::kNormalAttribute, 3);
  attribute(shared::kTangentAttribute, 4);
  attribute(shared::kUv0Attribute, 2);
  attribute(shared::kUv1Attribute, 2);
  attribute(shared::kColorAttribute, 4);
  // One value per draw; the base instance selects it.
  constexpr GLuint kFirstIndex = shared::kFirstIndexAttribute;
  glEnableVertexArrayAttrib(array, kFirstIndex);
  glVertexArrayAttribIFormat(array, kFirstIndex, 1, GL_UNSIGNED_INT, 0);
  glVertexArrayAttribBinding(array, kFirstIndex, kFirstIndex);
  glVertexArrayBindingDivisor(array, kFirstIndex, 1);
}

void GlScene::update(const RenderScene& scene, const RenderSceneChanges& changes) {
  const bool all = changes.rebuilt || scene_ != &scene;
  scene_ = &scene;
  if (all || !hasRoom()) {
    uploadGeometry();
  } else {
    for (size_t i = 0; i < changes.movedObjects.size(); ++i)
      uploadObject(changes.movedObjects[i], changes.movedBounds[i].empty());
  }
  if (all || changes.objects || changes.materials || !changes.emissions.empty() ||
      !changes.switchedObjects.empty())
    uploadMaterials();
}

bool GlScene::hasRoom() const {
  return scene_->positions.size() <= vertexRoom_ && scene_->indices.size() <= indexRoom_ &&
         scene_->objects.size() <= objectRoom_;
}

void GlScene::allocate() {
  const RenderScene& s = *scene_;
  if (std::max(s.positions.size(), s.indices.size() / 3) * sizeof(vec3) > mostStorageBytes()) {
    throw InputError(
        "scene", std::to_string(s.triangleCount()) + " triangles exceed the limit of this driver",
        "use --backend cpu");
  }
  const size_t most = mostStorageBytes() / sizeof(vec3);
  vertexRoom_ = std::min(withMore(s.positions.size()), most);
  indexRoom_ = std::min(withMore(s.indices.size()), 3 * most);
  objectRoom_ = withMore(s.objects.size());
  bytes_ = 0;
  positions_ = makeRoom<vec3>(vertexRoom_, bytes_);
  normals_ = makeRoom<vec3>(vertexRoom_, bytes_);
  tangents_ = makeRoom<vec4>(vertexRoom_, bytes_);
  uv0_ = makeRoom<vec2>(vertexRoom_, bytes_);
  uv1_ = makeRoom<vec2>(vertexRoom_, bytes_);
  colors_ = makeRoom<vec4>(vertexRoom_, bytes_);
  indices_ = makeRoom<uint32_t>(indexRoom_, bytes_);
  firstIndices_ = makeRoom<uint32_t>(objectRoom_, bytes_);
  leftOut_ = makeRoom<uint32_t>(s.hasLinks ? indexRoom_ / 3 : 1, bytes_);
}

void GlScene::uploadGeometry() {
  allocate();
  const RenderScene& s = *scene_;
  const auto vertices = static_cast<uint32_t>(s.positions.size());
  uploadRange(positions_, s.positions, 0, vertices);
  uploadRange(normals_, s.normals, 0, vertices);
  uploadRange(tangents_, s.tangents, 0, vertices);
  uploadRange(uv0_, s.uv0, 0, vertices);
  uploadRange(uv1_, s.uv1, 0, vertices);
  uploadRange(colors_, s.colors, 0, vertices);
  uploadRange(indices_, s.indices, 0, static_cast<uint32_t>(s.indices.size()));
  std::vector<uint32_t> firstIndices;
  for (const RenderObject& o : s.objects) {
    firstIndices.push_back(o.firstIndex);
    uploaded_ += o.isEmpty() ? 0 : 1;
  }
  uploadRange(firstIndices_, firstIndices, 0, static_cast<uint32_t>(firstIndices.size()));
  if (s.hasLinks)
    for (const RenderObject& o : s.objects) uploadLeftOut(leftOut_, o);

  const auto bind = [&](int binding, const Buffer& buffer, size_t stride) {
    glVertexArrayVertexBuffer(vertexArray_.name(), static_cast<GLuint>(binding), buffer.name(), 0,
                              static_cast<GLsizei>(stride));
  };
  bind(shared::kPositionAttribute, positions_, sizeof(vec3));
  bind(shared::kNormalAttribute, normals_, sizeof(vec3));
  bind(shared::kTangentAttribute, tangents_, sizeof(vec4));
  bind(shared::kUv0Attribute, uv0_, sizeof(vec2));
  bind(shared::kUv1Attribute, uv1_, sizeof(vec2));
  bind(shared::kColorAttribute, colors_, sizeof(vec4));
  bind(shared::kFirstIndexAttribute, firstIndices_, sizeof(uint32_t));
  glVertexArrayElementBuffer(vertexArray_.name(), indices_.name());
}

void GlScene::uploadObject(uint32_t object, bool isNew) {
  const RenderObject& o = scene_->objects[object];
  if (o.isEmpty()) return;
  ++uploaded_;
  uploadRange(positions_, scene_->positions, o.firstVertex, o.vertexCount);
  uploadRange(normals_, scene_->normals, o.firstVertex, o.vertexCount);
  uploadRange(tangents_, scene_->tangents, o.firstVertex, o.vertexCount);
  // a mirroring transform reverses the winding
  uploadRange(indices_, scene_->indices, o.firstIndex, o.indexCount);
  if (!isNew) return;
  uploadRange(uv0_, scene_->uv0, o.firstVertex, o.vertexCount);
  uploadRange(uv1_, scene_->uv1, o.firstVertex, o.vertexCount);
  uploadRange(colors_, scene_->colors, o.firstVertex, o.vertexCount);
  glNamedBufferSubData(firstIndices_.name(), static_cast<GLintptr>(object * sizeof(uint32_t)),
                       sizeof(uint32_t), &o.firstIndex);
  if (scene_->hasLinks) uploadLeftOut(leftOut_, o);
}

void GlScene::uploadMaterials() {
  const RenderScene& s = *scene_;
  GLint alignment = 1;
  glGetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &alignment);
  constexpr GLintptr kSize = sizeof(shared::SurfaceMaterial);
  materialStride_ = (kSize + alignment - 1) / alignment * alignment;
  std::vector<std::byte> blocks(static_cast<size_t>(materialStride_) * s.materials.size());
  for (size_t i = 0; i < s.materials.size(); ++i) {
    const shared::SurfaceMaterial m = surfaceMaterial(s.materials[i]);
    std::memcpy(blocks.data() + i * static_cast<size_t>(materialStride_), &m, sizeof(m));
  }
  uint64_t bytes = 0;
  materials_ = upload(blocks, bytes);

  drawn_.clear();
  std::vector<bool> used(s.materials.size(), false);
  for (uint32_t i = 0; i < s.objects.size(); ++i) {
    if (s.objects[i].isEmpty()) continue;
    const Material& m = s.materials[s.objects[i].material];
    if (m.isClear()) continue;
    used[s.objects[i].material] = true;
    drawn_.push_back({i, s.objects[i].material, isTextured(m), m.alphaMode == AlphaMode::mask,
                      s.backIsUnseen(i)});
  }
  std::stable_sort(drawn_.begin(), drawn_.end(), [](const Drawn& a, const Drawn& b) {
    return std::tuple(a.masked, a.textured, a.material) <
           std::tuple(b.masked, b.textured, b.material);
  });

  textures_.beginUse();
  materialTextures_.assign(s.materials.size(), {});
  const auto get = [&](const TextureRef& ref, bool srgb) {
    return ref.texture == kNone ? 0 : textures_.get(s.textures[ref.texture], srgb);
  };
  for (size_t i = 0; i < s.materials.size(); ++i) {
    if (!used[i]) continue;
    const Material& m = s.materials[i];
    materialTextures_[i] = {get(m.baseColorTexture, true), get(m.normalTexture, false),
                            m.emits() ? get(m.emissiveTexture, true) : 0,
                            get(m.metallicRoughnessTexture, false)};
  }
  textures_.endUse();
}

void GlScene::bindStorage() const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shared::kPositionBuffer, positions_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shared::kIndexBuffer, indices_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shared::kUv0Buffer, uv0_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shared::kUv1Buffer, uv1_.name());
}

void GlScene::bindCorners() const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shared::kCornerBuffer, indices_.name());
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shared::kPlaceBuffer, positions_.name());
}

void GlScene::bindLeftOut() const {
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, shared::kLeftOutBuffer, leftOut_.name());
}

void GlScene::bindMaterial(int material) const {
  glBindBufferRange(GL_UNIFORM_BUFFER, shared::kMaterialBlock, materials_.name(),
                    material * materialStride_, sizeof(shared::SurfaceMaterial));
  const MaterialTextures& t = materialTextures_[static_cast<size_t>(material)];
  glBindTextureUnit(shared::kBaseColorTexture, t.baseColor);
  glBindTextureUnit(shared::kNormalTexture, t.normal);
  glBindTextureUnit(shared::kEmissiveTexture, t.emissive);
  glBindTextureUnit(shared::kGlossTexture, t.gloss);
}

}  // namespace lamplighter::gl
