#include "tests/support/traced_shadows.h"

#include <tbb/parallel_for.h>

#include "renderer/methods/many_lights/parameters.h"
#include "renderer/scene/surface.h"
#include "shaders/shared/vpl_shading.h"
#include "shaders/shared/vpl_speculars.h"

namespace lamplighter::test {
namespace {

bool isShadowed(const RayCaster& rays, const vec3& from, const shared::Vpl& vpl) {
  const vec3 axis(vpl.normal), at(vpl.position);
  if (vpl.position.w == shared::kVplDirectional) return rays.occluded({from, 0.0f, axis});
  return rays.occluded({from, 0.0f, at + 2.0f * rayEpsilon(at) * axis - from, 1.0f});
}

}  // namespace

std::vector<shared::Vpl> shownLights(const Inspection& inspection) {
  std::vector<shared::Vpl> vpls;
  for (const LightSample& light : inspection.lights)
    if (light.isLive) vpls.push_back(light.vpl);
  return vpls;
}

Image withTracedShadows(const RenderScene& scene, const RayCaster& rays,
                        std::span<const shared::Vpl> vpls, const View& view,
                        const Settings& settings, const PatchView* known) {
  const ManyLightsParameters parameters = manyLightsParameters().read(settings);
  const float clampDistance = parameters.clampDistance, least = parameters.leastRoughness;
  const auto radiance = [&](int x, int y) {
    const Ray ray{view.eye, 0.0f,
                  view.rayDirection(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f)};
    const Hit hit = rays.intersect(ray, Surfaces::seen);
    if (!hit) return scene.sky.radianceFrom(ray.direction);
    const Surface s = surfaceAt(scene, hit.object, hit.triangle, hit.u, hit.v);
    const Gloss gloss =
        parameters.speculars ? glossAt(scene, hit.object, hit.triangle, hit.u, hit.v) : Gloss();
    const bool front = glm::dot(ray.direction, s.geometricNormal) < 0.0f;
    const vec3 ng = front ? s.geometricNormal : -s.geometricNormal;
    const vec3 ns = front ? s.normal : -s.normal;
    const vec3 start = s.position + rayEpsilon(s.position) * ng;
    const vec3 toEye = -glm::normalize(ray.direction);
    const float nv = glm::dot(toEye, ns);
    const bool isGlossy = shared::isGlossy(gloss.metallic, gloss.roughness);
    const shared::Lobe lobe =
        shared::makeLobe(s.albedo, gloss.metallic, gloss.roughness, least, nv);
    std::span<const uint8_t> states;
    if (known != nullptr)
      states = known->states(hit.object, known->leafAt(hit.object, hit.triangle, s.position));
    vec3 e(0.0f), reflected(0.0f);
    for (const shared::Vpl& vpl : vpls) {
      const float g = shared::vplGeometry(vpl, s.position, ns, ng, clampDistance);
      if (g == 0.0f) continue;
      const auto state = states.empty()
                             ? Occlusion::partial
                             : static_cast<Occlusion>(states[static_cast<size_t>(vpl.slot)]);
      if (state == Occlusion::full) continue;
      if (state == Occlusion::partial && isShadowed(rays, start, vpl)) continue;
      e += g * vpl.intensity;
      if (isGlossy)
        reflected +=
            vpl.intensity * shared::vplSpecular(vpl, lobe, s.position, ns, toEye, g, clampDistance);
    }
    const float share = shared::diffuseShare(gloss.metallic, gloss.roughness, least, nv);
    return (front || s.emitsBothSides ? s.emission : vec3(0.0f)) + share * s.albedo / kPi * e +
           reflected;
  };
  Image image(view.width, view.height);
  tbb::parallel_for(0, view.height, [&](int y) {
    for (int x = 0; x < view.width; ++x) image.at(x, y) = radiance(x, y);
  });
  return image;
}

}  // namespace lamplighter::test
