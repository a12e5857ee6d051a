#include "tests/support/scenes/lit_scene.h"

#include <cstring>

#include <gtest/gtest.h>

namespace lamplighter::test {

LitScene::LitScene(const Scene& scene, std::unique_ptr<Backend> on) : backend(std::move(on)) {
  const RenderSceneChanges changes = update(render, scene, SceneChanges::all());
  rays = std::make_unique<RayCaster>(render);
  backend->setScene(render, changes, *rays);
  kernels = &backend->kernels<ManyLightsKernels>("many_lights");
}

Image LitScene::sum(std::vector<shared::Vpl> vpls, const View& view, int resolution, bool shadows,
                    float clampDistance, float bias) {
  kernels->reserveShadowMaps(static_cast<int>(vpls.size()), resolution);
  for (size_t i = 0; i < vpls.size(); ++i) {
    vpls[i].slot = shadows ? static_cast<int>(i) : -1;
  }
  if (shadows) kernels->renderShadowMaps(vpls);
  backend->renderGBuffer(view, vec2(0.0f));
  kernels->sumVpls(vpls, {vec4(clampDistance, bias, resolution, vpls.size())}, nullptr);
  return kernels->compose()->pixels();
}

shared::Vpl makeVpl(const vec3& position, const vec3& normal, float kind, float angle) {
  const vec3 n = glm::normalize(normal);
  const Frame frame(n);
  const vec3 tangent = std::cos(angle) * frame.tangent + std::sin(angle) * frame.bitangent;
  return {vec4(position, kind), vec4(n, 0.0f), vec4(glm::normalize(tangent), 1.0f), vec3(1.0f), 0};
}

GiOutput renderSettled(FrameRenderer& renderer, const Scene& scene, const SceneChanges& changes,
                       const View& view, const Settings& settings, int limit) {
  GiOutput out;
  for (int frame = 0; frame < limit; ++frame) {
    out = renderer.render(
        {scene, frame == 0 ? changes : SceneChanges(), view, "many_lights", settings});
    if (out.settled) return out;
  }
  ADD_FAILURE() << "not settled after " << limit << " frames";
  return out;
}

Image settledPicture(FrameRenderer& renderer, const Scene& scene, const SceneChanges& changes,
                     const View& view, const Settings& settings) {
  return renderSettled(renderer, scene, changes, view, settings).radiance->pixels();
}

Image freshPicture(std::unique_ptr<Backend> backend, const Scene& scene, const View& view,
                   const Settings& settings) {
  FrameRenderer renderer(std::move(backend));
  return settledPicture(renderer, scene, SceneChanges::all(), view, settings);
}

ManyLightsCounts lightCounts(Backend& backend) {
  const auto* kernels = backend.kernelsInUse<ManyLightsKernels>();
  return kernels == nullptr ? ManyLightsCounts() : kernels->lightCounts();
}

bool sameBits(const Image& a, const Image& b) {
  return a.width == b.width && a.height == b.height &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(vec3)) == 0;
}

}  // namespace lamplighter::test
