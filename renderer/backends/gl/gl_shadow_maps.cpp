#include "renderer/backends/gl/gl_shadow_maps.h"

#include <algorithm>
#include <stdexcept>

#include "renderer/error.h"
#include "renderer/gl/pass_state.h"
#include "renderer/raycast/ray_caster.h"
#include "shaders/shared/shadow_depth.h"

namespace lamplighter::gl {
namespace {

// Of one array: drivers refuse or swap what is larger, and Mesa's llvmpipe ends at a gigabyte.
constexpr uint64_t kMaxArrayBytes = uint64_t{512} << 20;

// When the arrays are full they get at least this part more, so that growing is rare.
constexpr int kGrowth = 4;

// Share of a texel by which the faces of the octahedron reach over its creases.
constexpr float kCreaseTexels = 0.01f;

// Which part of the light's hemisphere an axis-aligned box may be in.
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
    // Rounding, and the little by which faces overlap.
    slack_ = 1e-3f * (std::abs(centre_.x) + std::abs(centre_.y) + std::abs(centre_.z) + reach_.x +
                      reach_.y + reach_.z);
  }
  bool touchesFace(const vec2& face) const {
    return face.x * centre_.x + reach_.x >= -slack_ && face.y * centre_.y + reach_.y >= -slack_ &&
           centre_.z + reach_.z >= -slack_;
  }
  // The square [-side, side]² about the light, all along its axis.
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

void GlShadowMaps::reserve(int slots, int resolution, int most) {
  if (static_cast<size_t>(slots) == places_.size() && resolution == resolution_ && most == most_)
    return;
  GLint maxLayers = 1, maxSize = 1;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &maxLayers);
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &maxSize);
  arrays_.clear();
  places_.clear();
  free_.clear();
  resolution_ = room_ = held_ = 0;
  if (resolution > maxSize) {
    throw InputError("many_lights",
                     "OpenGL takes shadow maps of " + std::to_string(maxSize) + "² texels at most",
                     "lower map_resolution");
  }
  const uint64_t mapBytes = uint64_t{4} * resolution * resolution;
  const uint64_t fitting = std::max<uint64_t>(kMaxArrayBytes / mapBytes, 1);
  placesAnArray_ = static_cast<int>(std::min<uint64_t>(maxLayers, fitting));
  isDirectional_.assign(static_cast<size_t>(slots), false);
  places_.assign(static_cast<size_t>(slots), kNone);
  resolution_ = resolution;
  most_ = most;
}

Texture GlShadowMaps::makeArray(int layers) const {
  while (glGetError() != GL_NO_ERROR) {
  }
  Texture array = Texture::make(GL_TEXTURE_2D_ARRAY);
  glTextureStorage3D(array.name(), 1, GL_DEPTH_COMPONENT32F, resolution_, resolution_, layers);
  if (glGetError() != GL_NO_ERROR) {
    throw InputError("many_lights",
                     "no video memory for " + std::to_string(layers) + " shadow maps of " +
                         std::to_string(resolution_) + "² texels",
                     "lower map_memory or map_resolution");
  }
  glTextureParameteri(array.name(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(array.name(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return array;
}

// The last array is made larger, with what it holds, and then others are added.
void GlShadowMaps::grow(int places) {
  while (room_ < places) {
    const bool isFull = room_ % placesAnArray_ == 0;
    const int first = isFull ? room_ : room_ / placesAnArray_ * placesAnArray_;
    const int end = std::min(places, first + placesAnArray_);
    Texture array = makeArray(end - first);
    if (!isFull) {
      glCopyImageSubData(arrays_.back().name(), GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, array.name(),
                         GL_TEXTURE_2D_ARRAY, 0, 0, 0, 0, resolution_, resolution_, room_ - first);
      arrays_.pop_back();
    }
    arrays_.push_back(std::move(array));
    room_ = end;
  }
}

void GlShadowMaps::givePlace(int slot) {
  int& place = places_[static_cast<size_t>(slot)];
  if (place != kNone) return;
  if (held_ >= most_) throw std::length_error("more maps than reserved");
  ++held_;
  if (free_.empty()) {
    place = held_ - 1;
    return;
  }
  place = free_.back();
  free_.pop_back();
}

void GlShadowMaps::drop(std::span<const int> slots) {
  for (const int slot : slots) {
    int& place = places_[static_cast<size_t>(slot)];
    if (place == kNone) continue;
    free_.push_back(place);
    place = kNone;
    --held_;
  }
}

void GlShadowMaps::render(const GlScene& scene, std::span<const shared::Vpl> vpls,
                          const VplBuffer& buffer) {
  if (vpls.empty()) return;
  int places = 0;
  for (const shared::Vpl& vpl : vpls) {
    const int slot = static_cast<int>(vpl.intensity.w);
    givePlace(slot);
    places = std::max(places, places_[static_cast<size_t>(slot)] + 1);
  }
  if (places > room_) grow(std::min(std::max(places, room_ + room_ / kGrowth), most_));
  PassState state(framebuffer_.name(), resolution_, resolution_);
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
  const int slot = static_cast<int>(vpl.intensity.w);
  glNamedFramebufferTextureLayer(framebuffer_.name(), GL_DEPTH_ATTACHMENT,
                                 array(place(slot) / placesAnArray_), 0,
                                 place(slot) % placesAnArray_);
  const float nothing = 0.0f;
  glClearNamedFramebufferfv(framebuffer_.name(), GL_DEPTH, 0, &nothing);
  const bool directional = vpl.position.w == shared::kVplDirectional;
  isDirectional_[static_cast<size_t>(slot)] = directional;
  if (directional) {
    drawFace(scene, vpl, directional_, indexInBuffer, nullptr);
    return;
  }
  for (const vec2& face : {vec2(1, 1), vec2(1, -1), vec2(-1, 1), vec2(-1, -1)}) {
    drawFace(scene, vpl, hemisphere_, indexInBuffer, &face);
  }
}

// face: null for a directional map, which has but one.
void GlShadowMaps::drawFace(const GlScene& scene, const shared::Vpl& vpl, const Programs& programs,
                            int indexInBuffer, const vec2* face) {
  const auto prepare = [&](const Program& program) {
    program.use();
    program.set(0, indexInBuffer);
    if (face == nullptr) return;
    program.set(1, *face);
    program.set(2, kCreaseTexels * 2.0f / static_cast<float>(resolution_));
    program.set(3, rayEpsilon(vec3(vpl.position)));
  };
  const RenderScene& s = scene.scene();
  counts_.clear();
  offsets_.clear();
  uint32_t end = 0;  // of the last range; neighbours make one
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

std::vector<float> GlShadowMaps::read(int slot) const {
  if (place(slot) == kNone) return {};
  std::vector<float> map(static_cast<size_t>(resolution_) * resolution_);
  glGetTextureSubImage(array(place(slot) / placesAnArray_), 0, 0, 0, place(slot) % placesAnArray_,
                       resolution_, resolution_, 1, GL_DEPTH_COMPONENT, GL_FLOAT,
                       static_cast<GLsizei>(map.size() * sizeof(float)), map.data());
  if (!isDirectional_[static_cast<size_t>(slot)]) {
    for (float& v : map) v *= 1.0f / shared::kShadowDepthUnit;
  }
  return map;
}

uint64_t GlShadowMaps::bytes() const { return uint64_t{4} * room_ * resolution_ * resolution_; }

}  // namespace lamplighter::gl
