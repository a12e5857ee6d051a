#include "renderer/surface_light/surface_picture.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "renderer/scene/surface.h"
#include "shaders/shared/brdf.h"

namespace lamplighter {
namespace {

constexpr float kMost = 65535.0f;

uint16_t packed(float share) {
  return static_cast<uint16_t>(std::clamp(share, 0.0f, 1.0f) * kMost + 0.5f);
}

// Weights of the second and third vertex of the triangle that a pixel shows.
struct SeenTriangle {
  vec2 weights{0.0f};
  bool isBack = false, isSound = false;

  SeenTriangle(const RenderScene& scene, const GBufferPoint& p) {
    const uint32_t* i = &scene.indices[scene.objects[p.object].firstIndex + 3 * p.triangle];
    const vec3& a = scene.positions[i[0]];
    const vec3 ab = scene.positions[i[1]] - a, ac = scene.positions[i[2]] - a;
    const vec3 cross = glm::cross(ab, ac), d = p.position - a;
    const float area2 = glm::dot(cross, cross);
    isSound = area2 > 0.0f;
    if (!isSound) return;
    weights.x = std::clamp(glm::dot(glm::cross(d, ac), cross) / area2, 0.0f, 1.0f);
    weights.y = std::clamp(glm::dot(glm::cross(ab, d), cross) / area2, 0.0f, 1.0f - weights.x);
    isBack = glm::dot(cross, p.geometricNormal) < 0.0f;
  }
};

// π × the share of even light that is reflected towards the eye. A lobe reflects even light as its
// directional albedo.
vec3 reflectanceOf(const RenderScene& scene, const GBufferPoint& p, const vec2& weights,
                   const vec3& eye, const SurfacePictureOptions& options) {
  if (options.white) return vec3(1.0f);
  const Material& m = scene.materials[static_cast<size_t>(scene.objects[p.object].material)];
  if (!options.speculars || !mayBeGlossy(m)) return p.albedo;
  const Gloss gloss = glossAt(scene, p.object, p.triangle, weights.x, weights.y);
  if (!shared::isGlossy(gloss.metallic, gloss.roughness)) return p.albedo;
  const float nv = glm::dot(p.normal, glm::normalize(eye - p.position));
  const float diffuse =
      shared::diffuseShare(gloss.metallic, gloss.roughness, options.leastRoughness, nv);
  const float dielectric = (1.0f - gloss.metallic) * shared::dielectricShare(gloss.roughness) *
                           shared::dielectricAlbedo(gloss.roughness, options.leastRoughness, nv);
  return diffuse * p.albedo + gloss.metallic * p.albedo + vec3(dielectric);
}

}  // namespace

void SurfacePicture::restart(int width, int height, int samples) {
  width_ = width;
  height_ = height;
  samples_ = samples;
  added_ = 0;
  points_.assign(
      static_cast<size_t>(width) * static_cast<size_t>(height) * static_cast<size_t>(samples), {});
}

void SurfacePicture::add(const RenderScene& scene, const RayCaster& rays, const SurfaceMesh& mesh,
                         const CutLeaves& cuts, const GBufferView& gbuffer, const vec3& eye,
                         const SurfacePictureOptions& options) {
  const size_t pixels = static_cast<size_t>(width_) * static_cast<size_t>(height_);
  Point* points = points_.data() + static_cast<size_t>(added_++) * pixels;
  tbb::parallel_for(0, height_, [&](int y) {
    for (int x = 0; x < width_; ++x) {
      if (!gbuffer.isHit(x, y)) continue;
      const GBufferPoint p = gbuffer.at(x, y);
      const SeenTriangle seen(scene, p);
      MeshPoint at;
      if (!seen.isSound || !mesh.find(scene, p.object, p.triangle, seen.isBack, seen.weights, at))
        continue;
      cuts.keepVisible(scene, rays, mesh, p.position, at.leaf, at.weights);
      const vec3 reflectance = reflectanceOf(scene, p, seen.weights, eye, options);
      Point& out =
          points[static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)];
      out.values = at.values;
      out.weights = {packed(at.weights.y), packed(at.weights.z)};
      out.reflectance = {packed(reflectance.r), packed(reflectance.g), packed(reflectance.b)};
    }
  });
}

void SurfacePicture::addTo(std::span<const vec3> irradiance, Image& picture) const {
  if (added_ == 0 || irradiance.empty()) return;
  const size_t pixels = picture.pixels.size();
  const float scale = 1.0f / (kMost * kPi * static_cast<float>(added_));
  tbb::parallel_for(0, height_, [&](int y) {
    const size_t first = static_cast<size_t>(y) * static_cast<size_t>(width_);
    for (size_t i = first; i < first + static_cast<size_t>(width_); ++i) {
      vec3 sum(0.0f);
      for (int s = 0; s < added_; ++s) {
        const Point& p = points_[static_cast<size_t>(s) * pixels + i];
        const float u = static_cast<float>(p.weights[0]) / kMost;
        const float v = static_cast<float>(p.weights[1]) / kMost;
        sum += vec3(p.reflectance[0], p.reflectance[1], p.reflectance[2]) *
               ((1.0f - u - v) * irradiance[p.values[0]] + u * irradiance[p.values[1]] +
                v * irradiance[p.values[2]]);
      }
      picture.pixels[i] += scale * sum;
    }
  });
}

}  // namespace lamplighter
