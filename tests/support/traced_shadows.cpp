#include "tests/support/traced_shadows.h"

#include <tbb/parallel_for.h>

#include "renderer/light_maps/patch_lights.h"
#include "renderer/methods/common_parameters.h"
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
                        const Settings& settings, const VisibilityDatabase* visibility) {
  const float clampDistance = settings.real(parameters::clampDistance());
  const float least = settings.real(parameters::leastRoughness());
  const bool speculars = settings.boolean(parameters::speculars());
  const auto radiance = [&](int x, int y) {
    const Ray ray{view.eye, 0.0f,
                  view.rayDirection(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f)};
    const Hit hit = rays.intersect(ray, Surfaces::seen);
    if (!hit) return scene.sky.radianceFrom(ray.direction);
    const Surface s = surfaceAt(scene, hit.object, hit.triangle, hit.u, hit.v);
    const Gloss gloss =
        speculars ? glossAt(scene, hit.object, hit.triangle, hit.u, hit.v) : Gloss();
    const bool front = glm::dot(ray.direction, s.geometricNormal) < 0.0f;
    const vec3 ng = front ? s.geometricNormal : -s.geometricNormal;
    const vec3 ns = front ? s.normal : -s.normal;
    const vec3 start = s.position + rayEpsilon(s.position) * ng;
    const vec3 toEye = -glm::normalize(ray.direction);
    const float nv = glm::dot(toEye, ns);
    const bool isGlossy = shared::isGlossy(gloss.metallic, gloss.roughness);
    const shared::Lobe lobe =
        shared::makeLobe(s.albedo, gloss.metallic, gloss.roughness, least, nv);
    std::vector<ShadowMode> uses;
    if (visibility != nullptr) {
      uses.resize(visibility->slots());
      const int leaf = visibility->patches(hit.object).leafAt(hit.triangle, s.position);
      PatchLights(*visibility, nullptr).uses(hit.object, leaf, false, uses);
    }
    vec3 e(0.0f), reflected(0.0f);
    for (const shared::Vpl& vpl : vpls) {
      const float g = shared::vplGeometry(vpl, s.position, ns, ng, clampDistance);
      if (g == 0.0f) continue;
      const ShadowMode use =
          uses.empty() ? ShadowMode::addShadowed : uses[static_cast<size_t>(vpl.slot)];
      if (use == ShadowMode::skip) continue;
      if (use == ShadowMode::addShadowed && isShadowed(rays, start, vpl)) continue;
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
