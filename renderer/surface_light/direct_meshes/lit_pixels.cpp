#include "renderer/surface_light/direct_meshes/lit_pixels.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "renderer/surface_light/pixels/seen_triangle.h"

namespace lamplighter {
namespace {

// Maximum factor by which a normal map brightens a light.
constexpr float kMostMapped = 8.0f;
constexpr size_t kLeastPlaces = 4;
constexpr size_t kPixelsATask = 1024;

float ratioOf(float a, float b) { return b > 0.0f ? a / b : 0.0f; }

}  // namespace

LitPixels::LitPixels(const RenderScene& scene, const GBufferView& gbuffer, const vec3& eye,
                     const SurfacePictureOptions& options)
    : eye_(eye),
      pixels_(static_cast<size_t>(gbuffer.width()) * static_cast<size_t>(gbuffer.height())) {
  tbb::parallel_for(0, gbuffer.height(), [&](int y) {
    for (int x = 0; x < gbuffer.width(); ++x) {
      if (!gbuffer.isHit(x, y)) continue;
      const GBufferPoint g = gbuffer.at(x, y);
      const SeenTriangle seen(scene, g);
      if (!seen.isSound) continue;
      Pixel& p = pixels_[static_cast<size_t>(y * gbuffer.width() + x)];
      const Material& m = scene.materials[static_cast<size_t>(scene.objects[g.object].material)];
      p.isLit = true;
      p.position = g.position;
      p.normal = g.normal;
      p.diffuse = reflectanceOf(scene, g, seen.weights, eye, options).diffuse;
      p.isMapped = m.normalTexture.texture != kNone;
      if (p.isMapped) {
        const uint32_t triangles = scene.objects[g.object].triangleCount();
        p.smooth =
            spotAt(scene, g.object,
                   {g.triangle + (seen.isBack ? triangles : 0), seen.weights.x, seen.weights.y})
                .normal;
      }
      if (options.white || !options.speculars || !mayBeGlossy(m)) continue;
      const Gloss gloss = glossAt(scene, g.object, g.triangle, seen.weights.x, seen.weights.y);
      p.isGlossy = shared::isGlossy(gloss.metallic, gloss.roughness);
      if (p.isGlossy)
        p.lobe = shared::makeLobe(g.albedo, gloss.metallic, gloss.roughness, options.leastRoughness,
                                  glm::dot(g.normal, glm::normalize(eye - g.position)));
    }
  });
}

// Number of points that give a smooth highlight: each of them widens the lobe by less than a
// quarter (shared::widened()).
size_t LitPixels::placesFor(const Pixel& p, std::span<const EmitterPoint> points) {
  const EmitterPoint& e = points.front();
  const vec3 d = e.position - p.position;
  const float solidAngle = e.area / std::max(glm::dot(d, d), 1e-6f);
  const float widest = kPi * p.lobe.shape.x / shared::kSpread;
  size_t places = kLeastPlaces;
  while (places < points.size() && solidAngle > widest * static_cast<float>(places)) places *= 4;
  return std::min(places, points.size());
}

// ∫ f cos θ of the lobe, per unit of brightness, without occlusion.
vec3 LitPixels::highlightOf(const Pixel& p, const LightFactor& light) const {
  const vec3 toEye = glm::normalize(eye_ - p.position);
  const auto points = light.points().first(placesFor(p, light.points()));
  const auto count = static_cast<float>(points.size());
  vec3 sum(0.0f);
  for (const EmitterPoint& e : points) {
    const vec3 d = e.position - p.position;
    const float d2 = glm::dot(d, d);
    if (!(d2 > 0.0f)) continue;
    const vec3 w = d / std::sqrt(d2);
    const float there = e.bothSides ? std::abs(glm::dot(e.normal, w)) : -glm::dot(e.normal, w);
    const float here = glm::dot(p.normal, w);
    if (here <= 0.0f || there <= 0.0f) continue;
    const float area = e.area / count;
    const float solidAngle = there * area / (d2 + area / kPi);
    sum += shared::lobeTowards(p.lobe, here, glm::dot(w, toEye), solidAngle) * here * solidAngle *
           e.share;
  }
  return sum;
}

void LitPixels::reflect(std::span<const Light> lights, std::span<const vec3> irradiance,
                        std::vector<vec3>& radiance) const {
  radiance.resize(pixels_.size());
  const size_t tasks = (pixels_.size() + kPixelsATask - 1) / kPixelsATask;
  tbb::parallel_for(size_t{0}, tasks, [&](size_t task) {
    const size_t end = std::min((task + 1) * kPixelsATask, pixels_.size());
    for (size_t i = task * kPixelsATask; i < end; ++i) {
      const Pixel& p = pixels_[i];
      radiance[i] = vec3(0.0f);
      if (!p.isLit || irradiance[i] == vec3(0.0f)) continue;
      vec3 here = irradiance[i];
      if (p.isMapped || p.isGlossy) {
        vec3 smooth(0.0f), mapped(0.0f), highlight(0.0f);
        for (const Light& l : lights) {
          const vec3 open =
              l.weight * l.factor->unshadowed(p.position, p.isMapped ? p.smooth : p.normal);
          smooth += open;
          if (p.isMapped) mapped += l.weight * l.factor->unshadowed(p.position, p.normal);
          if (p.isGlossy) highlight += l.weight * highlightOf(p, *l.factor);
        }
        const float arriving = std::min(ratioOf(luminance(here), luminance(smooth)), 1.0f);
        if (p.isMapped)
          here *= std::min(ratioOf(luminance(mapped), luminance(smooth)), kMostMapped);
        radiance[i] = arriving * highlight;
      }
      radiance[i] += p.diffuse / kPi * here;
    }
  });
}

}  // namespace lamplighter
