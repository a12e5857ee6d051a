#include "renderer/backends/gl/many_lights/gl_shadow_maps.h"

#include <algorithm>
#include <stdexcept>

#include "renderer/base/error.h"
#include "renderer/gl/debug.h"
#include "renderer/gl/pass_state.h"
#include "renderer/raycast/ray_caster.h"
#include "shaders/shared/shadow_depth.h"

namespace lamplighter::gl {
namespace {

// Limit per array: drivers refuse or swap larger ones, and Mesa's llvmpipe supports at most 1 GiB.
constexpr uint64_t kMaxArrayBytes = uint64_t{512} << 20;

// Full arrays grow by at least a fourth, so that growth is rare.
constexpr int kGrowth = 4;

// How far the faces of the octahedron extend past its creases, in texels.
constexpr float kCreaseTexels = 0.01f;

// Which parts of the light's hemisphere an axis-aligned box may reach.
class BoxInLight {
 public:
  BoxInLight(const Bounds& box, const shared::Vpl& vpl) {
    const vec3 n(vpl.normal), t(vpl.tangent);
    const vec3 axes[3] = {t, glm::cross(n, t), n};
    const vec3 half = 0.5f * (box.max - box.min);
    const vec3 c = 0.5f * (box.max + box.min) - vec3(vpl.position);
    for (int i = 0; i < 3; ++i) {
      centre_[i] = glm::dot(c, axes[i]);
      reach_[i] = glm::dot(half, glm::abs(axes[i]));
    }
    // Tolerance for rounding, and for the overlap of faces.
    slack_ = 1e-3f * (std::abs(centre_.x) + std::abs(centre_.y) + std::abs(centre_.z) + reach_.x +
                      reach_.y + reach_.z);
  }
  bool touchesFace(const vec2& face) const {
    return face.x * centre_.x + reach_.x >= -slack_ && face.y * centre_.y + reach_.y >= -slack_ &&
           centre_.z + reach_.z >= -slack_;
  }
  // The square [-side, side]² around the light, infinitely long along its axis.
  bool touchesSquare(float side) const {
    return std::abs(centre_.x) - reach_.x <= side + slack_ &&
           std::abs(centre_.y) - reach_.y <= side + slack_;
  }

 private:
  vec3 centre_{0.0f}, reach_{0.0f};
  float slack_ = 0.0f;
};

}  // namespace

GlShadowMaps::GlShadowMaps(const std::filesystem::path& shaders, const VplBuffer& vpls)
    : framebuffer_(Framebuffer::make()) {
  glNamedFramebufferDrawBuffer(framebuffer_.name(), GL_NONE);
  reload(shaders, vpls);
}

void GlShadowMaps::reload(const std::filesystem::path& shaders, const VplBuffer& vpls) {
  const char* vertex = "passes/shadow_map.vert.glsl";
  const char* mask = "passes/shadow_map_mask.frag.glsl";
  const std::string n = vpls.define();
  Programs hemisphere{Program(shaders, {vertex, "", {n}}),
                      Program(shaders, {vertex, mask, {n, "ALPHA_MASK"}})};
  Programs directional{Program(shaders, {vertex, "", {n, "DIRECTIONAL"}}),
                       Program(shaders, {vertex, mask, {n, "DIRECTIONAL", "ALPHA_MASK"}})};
  hemisphere_ = std::move(hemisphere);
  directional_ = std::move(directional);
}

void GlShadowMaps::reserve(int slots, const MapRoom& coarse, const MapRoom& fine) {
  if (static_cast<size_t>(slots) == slots_.size() && coarse == poolOf(MapSize::coarse).room &&
      fine == poolOf(MapSize::fine).room)
    return;
  GLint maxLayers = 1, maxSize = 1;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &maxLayers);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &maxSize);
  slots_.clear();
  for (Pool& pool : pools_) pool = {};
  if (std::max(coarse.resolution, fine.resolution) > maxSize) {
    throw InputError(
        "many_lights",
        "this driver supports shadow maps of at most " + std::to_string(maxSize) + "² texels",
        "lower map_resolution");
  }
  poolOf(MapSize::coarse).room = coarse;
  poolOf(MapSize::fine).room = fine;
  for (Pool& pool : pools_) {
    const uint64_t fitting = kMaxArrayBytes / std::max<uint64_t>(pool.mapBytes(), 1);
    pool.placesAnArray = static_cast<int>(std::clamp<uint64_t>(fitting, 1, maxLayers));
  }
  slots_.resize(static_cast<size_t>(slots));
}

Texture GlShadowMaps::makeArray(const Pool& pool, int layers) {
  const int resolution = pool.room.resolution;
  takeErrors();
  Texture array = Texture::make(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(array.name(), 1, GL_DEPTH_COMPONENT32F, resolution, resolution, layers);
  if (glGetError() != GL_NO_ERROR) {
    throw InputError("many_lights",
                     "no video memory for " + std::to_string(layers) + " shadow maps of " +
                         std::to_string(resolution) + "² texels",
                     "lower map_memory or map_resolution");
  }
  glTextureParameteri(array.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(array.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return array;
}

// Enlarges the last array, keeping its content, then adds arrays.
void GlShadowMaps::grow(Pool& pool, int places) {
  const int resolution = pool.room.resolution;
  while (pool.space < places) {
    const bool isFull = pool.space % pool.placesAnArray == 0;
    const int first = isFull ? pool.space : pool.space / pool.placesAnArray * pool.placesAnArray;
    const int end = std::min(places, first + pool.placesAnArray);
    Texture array = makeArray(pool, end - first);
    if (!isFull) {
      glCopyImageSubData(pool.arrays.back().name(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, array.name(),
                         GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, resolution, resolution,
                         pool.space - first);
      pool.arrays.pop_back();
    }
    pool.arrays.push_back(std::move(array));
    pool.space = end;
  }
}

GlShadowMaps::Place GlShadowMaps::place(int slot) const {
  if (slot < 0) return {};
  const Slot& s = slots_[static_cast<size_t>(slot)];
  if (s.place == kNone) return {};
  const auto size = static_cast<int>(s.size);
  const int inArray = pools_[static_cast<size_t>(size)].placesAnArray;
  return {2 * (s.place / inArray) + size, s.place % inArray};
}

void GlShadowMaps::givePlace(Slot& slot, MapSize size) {
  if (slot.place != kNone && slot.size == size) return;
  drop(slot);
  Pool& pool = poolOf(size);
  if (pool.held >= pool.room.maps) throw std::length_error("more maps than reserved");
  ++pool.held;
  slot.size = size;
  if (pool.free.empty()) {
    slot.place = pool.held - 1;
    return;
  }
  slot.place = pool.free.back();
  pool.free.pop_back();
}

void GlShadowMaps::drop(Slot& slot) {
  if (slot.place == kNone) return;
  Pool& pool = poolOf(slot.size);
  pool.free.push_back(slot.place);
  --pool.held;
  slot.place = kNone;
}

void GlShadowMaps::drop(std::span<const int> slots) {
  for (const int slot : slots) drop(slots_[static_cast<size_t>(slot)]);
}

void GlShadowMaps::render(const GlScene& scene, std::span<const shared::Vpl> vpls, MapSize size,
                          const VplBuffer& buffer) {
  if (vpls.empty()) return;
  Pool& pool = poolOf(size);
  int places = 0;
  for (const shared::Vpl& vpl : vpls) {
    Slot& slot = slots_[static_cast<size_t>(vpl.slot)];
    givePlace(slot, size);
    places = std::max(places, slot.place + 1);
  }
  if (places > pool.space)
    grow(pool, std::min(std::max(places, pool.space + pool.space / kGrowth), pool.room.maps));
  PassState state(framebuffer_.name(), pool.room.resolution, pool.room.resolution);
  state.reversedDepth();
  state.clipDistances(4);
  glBindVertexArray(scene.vertexArray());
  const auto capacity = static_cast<size_t>(buffer.capacity());
  for (size_t first = 0; first < vpls.size(); first += capacity) {
    const auto chunk = vpls.subspan(first, std::min(capacity, vpls.size() - first));
    buffer.upload(chunk);
    for (size_t i = 0; i < chunk.size(); ++i) renderMap(scene, chunk[i], static_cast<int>(i));
  }
  glNamedFramebufferTexture(framebuffer_.name(), GL_DEPTH_ATTACHMENT, 0, 0);
}

void GlShadowMaps::renderMap(const GlScene& scene, const shared::Vpl& vpl, int indexInBuffer) {
  const int slot = vpl.slot;
  const Place at = place(slot);
  glNamedFramebufferTextureLayer(framebuffer_.name(), GL_DEPTH_ATTACHMENT, array(at.array), 0,
                                 at.layer);
  const float nothing = 0.0f;
  glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &nothing);
  const bool directional = vpl.position.w == shared::kVplDirectional;
  slots_[static_cast<size_t>(slot)].isDirectional = directional;
  if (directional) {
    drawFace(scene, vpl, directional_, indexInBuffer, nullptr, resolution(at.array));
    return;
  }
  for (const vec2& face : {vec2(1, 1), vec2(1, -1), vec2(-1, 1), vec2(-1, -1)}) {
    drawFace(scene, vpl, hemisphere_, indexInBuffer, &face, resolution(at.array));
  }
}

// face: null for a directional map, which has only one face.
void GlShadowMaps::drawFace(const GlScene& scene, const shared::Vpl& vpl, const Programs& programs,
                            int indexInBuffer, const vec2* face, int resolution) {
  const auto prepare = [&](const Program& program) {
    program.use();
    program.set(0, indexInBuffer);
    if (face == nullptr) return;
    program.set(1, *face);
    program.set(2, kCreaseTexels * 2.0f / static_cast<float>(resolution));
    program.set(3, rayEpsilon(vec3(vpl.position)));
  };
  const RenderScene& s = scene.scene();
  counts_.clear();
  offsets_.clear();
  uint32_t end = 0;  // end of the last range; adjacent ranges are merged
  bool preparedMasked = false;
  for (const GlScene::Drawn& d : scene.drawn()) {
    const RenderObject& o = s.objects[d.object];
    const BoxInLight box(o.bounds, vpl);
    if (!(face == nullptr ? box.touchesSquare(vpl.tangent.w) : box.touchesFace(*face))) continue;
    const auto count = static_cast<GLsizei>(o.indexCount);
    const auto* offset = reinterpret_cast<const void*>(o.firstIndex * sizeof(uint32_t));
    if (!d.masked) {
      if (!counts_.empty() && end == o.firstIndex) {
        counts_.back() += count;
      } else {
        counts_.push_back(count);
        offsets_.push_back(offset);
      }
      end = o.firstIndex + o.indexCount;
      continue;
    }
    if (!preparedMasked) prepare(programs.masked);
    preparedMasked = true;
    scene.bindMaterial(d.material);
    glDrawElements(GL_TRIANGLES, count, GL_UNSIGNED_INT, offset);
  }
  if (counts_.empty()) return;
  prepare(programs.opaque);
  glMultiDrawElements(GL_TRIANGLES, counts_.data(), GL_UNSIGNED_INT, offsets_.data(),
                      static_cast<GLsizei>(counts_.size()));
}

std::vector<float> GlShadowMaps::read(Waits& waits, int slot) const {
  const Place at = place(slot);
  if (at.layer == kNone) return {};
  const int side = resolution(at.array);
  std::vector<float> map(static_cast<size_t>(side) * side);
  waits.readLayer(array(at.array), at.layer, {side, side}, GL_DEPTH_COMPONENT, GL_FLOAT,
                  map.size() * sizeof(float), map.data());
  if (!slots_[static_cast<size_t>(slot)].isDirectional) {
    for (float& v : map) v *= 1.0f / shared::kShadowDepthUnit;
  }
  return map;
}

}  // namespace lamplighter::gl
