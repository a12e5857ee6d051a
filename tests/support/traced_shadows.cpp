#include "tests/support/traced_shadows.h"

#include <tbb/parallel_for.h>

#include "renderer/methods/common_parameters.h"
#include "renderer/methods/many_lights/parameters.h"
#include "renderer/sampling/vpl_set.h"
#include "renderer/scene/surface.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter::test {

Image withTracedShadows(const Scene& scene, const View& view, const Settings& settings) {
  RenderScene render;
  update(render, scene, SceneChanges::all());
  const RayCaster rays(render);
  const VplCounts counts{settings.integer(parameters::vpls()),
                         settings.real(parameters::directShare()),
                         settings.integer(parameters::bounces()),
                         static_cast<uint32_t>(settings.integer(parameters::seed()))};
  const auto lights = generateVpls(render, rays, LightSet(render), counts).vpls;
  const auto radiance = [&](int x, int y) {
    const Ray ray{view.eye, 0.0f,
                  view.rayDirection(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f)};
    const Hit hit = rays.intersect(ray, Surfaces::seen);
    if (!hit) return render.sky.radianceFrom(ray.direction);
    const Surface s = surfaceAt(render, hit.object, hit.triangle, hit.u, hit.v);
    const bool front = glm::dot(ray.direction, s.geometricNormal) < 0.0f;
    const vec3 ng = front ? s.geometricNormal : -s.geometricNormal;
    const vec3 start = s.position + rayEpsilon(s.position) * ng;
    vec3 e(0.0f);
    for (const SceneVpl& light : lights) {
      const shared::Vpl& vpl = light.vpl;
      const float g = shared::vplGeometry(vpl, s.position, front ? s.normal : -s.normal, ng,
                                          settings.real(parameters::clampDistance()));
      if (g == 0.0f) continue;
      const vec3 axis(vpl.normal), at(vpl.position);
      const bool parallel = vpl.position.w == shared::kVplDirectional;
      const vec3 way = parallel ? axis : at + 2.0f * rayEpsilon(at) * axis - start;
      if (!rays.occluded(parallel ? Ray{start, 0.0f, way} : Ray{start, 0.0f, way, 1.0f}))
        e += g * vec3(vpl.intensity);
    }
    return (front || s.emitsBothSides ? s.emission : vec3(0.0f)) + s.albedo / kPi * e;
  };
  Image image(view.width, view.height);
  tbb::parallel_for(0, view.height, [&](int y) {
    for (int x = 0; x < view.width; ++x) image.at(x, y) = radiance(x, y);
  });
  return image;
}

}  // namespace lamplighter::test
