#include "renderer/backends/gl/many_lights/gl_speculars.h"

#include <algorithm>
#include <vector>

#include "renderer/gl/pass_state.h"
#include "renderer/light_maps/patch_lights.h"
#include "renderer/scene/surface.h"
#include "shaders/shared/bindings.h"

namespace lamplighter::gl {
namespace {

bool hasGlossyObject(const GlScene& scene) {
  return std::any_of(scene.drawn().begin(), scene.drawn().end(), [&](const GlScene::Drawn& d) {
    return mayBeGlossy(scene.scene().materials[static_cast<size_t>(d.material)]);
  });
}

}  // namespace

GlSpeculars::GlSpeculars(const std::filesystem::path& shaders, const VplBuffer& vpls)
    : emptyVertexArray_(VertexArray::make()),
      sumFramebuffer_(Framebuffer::make()),
      pictureFramebuffer_(Framebuffer::make()) {
  reload(shaders, vpls);
}

void GlSpeculars::reload(const std::filesystem::path& shaders, const VplBuffer& vpls) {
  const char* vertex = "common/full_screen.vert.glsl";
  const std::string kinds[3] = {"VPL_KIND kVplCosine", "VPL_KIND kVplUniform",
                                "VPL_KIND kVplDirectional"};
  Program sums[3];
  for (int i = 0; i < 3; ++i) {
    std::vector<std::string> defines = {vpls.define(), kinds[i]};
    if (i == 2) defines.push_back("DIRECTIONAL");
    sums[i] = Program(shaders, {vertex, "passes/sum_speculars.frag.glsl", defines});
    linkedFiles_[i] = {vertex, "passes/sum_speculars.frag.glsl", defines};
    linkedFiles_[i].defines.push_back("LINKS");
  }
  Program add(shaders, {vertex, "passes/add_speculars.frag.glsl"});
  std::move(std::begin(sums), std::end(sums), sums_);
  for (Program& program : linked_) program = Program();
  shaders_ = shaders;
  add_ = std::move(add);
}

void GlSpeculars::sum(const GlScene& scene, const GlGBuffer& gbuffer, const GlShadowMaps& maps,
                      const VplBuffer& buffer, std::span<const shared::Vpl> vpls,
                      const shared::ShadingParams& params, const PatchLights* patches) {
  isOn_ = params.speculars.x != 0.0f && hasGlossyObject(scene);
  if (!isOn_) return;
  leastRoughness_ = params.speculars.y;
  if (width_ != gbuffer.width() || height_ != gbuffer.height()) {
    width_ = gbuffer.width();
    height_ = gbuffer.height();
    radiance_ = makeTexture2D(GL_RGBA32F, width_, height_);
    glNamedFramebufferTexture(sumFramebuffer_.name(), GL_COLOR_ATTACHMENT0, radiance_.name(), 0);
  }
  PassState state(sumFramebuffer_.name(), width_, height_);
  const float zero[4] = {0.0f, 0.0f, 0.0f, 0.0f};
  glClearNamedFramebufferfv(sumFramebuffer_.name(), GL_COLOR, 0, zero);
  state.additive();
  gbuffer.bind();

  // Keeps the order within each kind and array; each draw takes as many as a block holds. VPLs that
  // need a map but have none are skipped: their proxies replace them.
  struct Placed {
    shared::Vpl vpl;  // with the layer of its map
    int array = 0;
  };
  std::vector<Placed> sorted;
  sorted.reserve(vpls.size());
  for (const shared::Vpl& vpl : vpls) {
    Placed placed{vpl};
    const int slot = vpl.slot;
    if (slot >= 0) {
      if (patches != nullptr && patches->isGroup(slot)) continue;
      const auto [array, layer] = maps.place(patches == nullptr ? slot : patches->mapSlot(slot));
      if (layer == kNone) continue;
      placed.array = array;
      placed.vpl.slot = layer;
    }
    sorted.push_back(placed);
  }
  const auto batchOf = [](const Placed& placed) {
    return std::pair(static_cast<int>(placed.vpl.position.w), placed.array);
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const auto& a, const auto& b) { return batchOf(a) < batchOf(b); });
  const bool hasLinks = scene.scene().hasLinks;
  if (hasLinks) scene.bindLeftOut();
  const int aDraw = std::max(static_cast<int>(params.clampAndBias.w), 1);
  const size_t most = static_cast<size_t>(std::min(buffer.capacity(), aDraw));
  std::vector<shared::Vpl> batch;
  for (size_t first = 0; first < sorted.size();) {
    const auto [kind, array] = batchOf(sorted[first]);
    size_t end = first;
    while (end < sorted.size() && end - first < most &&
           batchOf(sorted[end]) == std::pair(kind, array))
      ++end;
    batch.clear();
    for (; first < end; ++first) batch.push_back(sorted[first].vpl);
    buffer.upload(batch);
    glBindTextureUnit(shared::kShadowMaps, maps.hasArray(array) ? maps.array(array) : 0);
    if (hasLinks && !linked_[kind]) linked_[kind] = Program(shaders_, linkedFiles_[kind]);
    const Program& program = hasLinks ? linked_[kind] : sums_[kind];
    program.use();
    program.set(0, gbuffer.eye());
    program.set(1, leastRoughness_);
    program.set(2, 0);
    program.set(3, static_cast<int>(batch.size()));
    vec4 clampAndBias = params.clampAndBias;
    clampAndBias.z = static_cast<float>(maps.resolution(array));
    program.set(4, clampAndBias);
    drawFullScreen(emptyVertexArray_.name());
  }
}

void GlSpeculars::addTo(const RadianceTexture& picture, const GlGBuffer& gbuffer,
                        GLuint irradiance) {
  if (!isOn_) return;
  glNamedFramebufferTexture(pictureFramebuffer_.name(), GL_COLOR_ATTACHMENT0, picture.texture(), 0);
  PassState state(pictureFramebuffer_.name(), width_, height_);
  state.additive();
  gbuffer.bind();
  glBindTextureUnit(shared::kIrradiance, irradiance);
  glBindTextureUnit(shared::kSpeculars, radiance_.name());
  add_.use();
  add_.set(0, gbuffer.eye());
  add_.set(1, leastRoughness_);
  drawFullScreen(emptyVertexArray_.name());
}

}  // namespace lamplighter::gl
