#include "renderer/methods/many_lights/emission_shares.h"

#include <tbb/parallel_for.h>

#include "renderer/backends/gbuffer_view.h"
#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

// Emission of a surface towards the eye, as a share of its emissive factor.
vec3 shareSeen(const RenderScene& scene, const RayCaster& rays, const Ray& ray,
               const LightControls& controls, int& control) {
  const Hit hit = rays.intersect(ray, Surfaces::seen);
  control = kNone;
  if (!hit) return vec3(0.0f);
  control = controls.ofObject[hit.object];
  if (control == kNone) return vec3(0.0f);
  const auto material = static_cast<size_t>(scene.objects[hit.object].material);
  const Surface s = surfaceAt(scene, hit.object, hit.triangle, hit.u, hit.v);
  const bool isFront = glm::dot(ray.direction, s.geometricNormal) < 0.0f;
  if (!isFront && !scene.materials[material].doubleSided) return vec3(0.0f);
  return emissionShareAt(scene, hit.object, hit.triangle, hit.u, hit.v);
}

}  // namespace

void EmissionShares::add(const FrameInputs& in, const LightControls& controls, vec2 jitter,
                         float weight) {
  ofControl_.resize(controls.size());
  const GBufferView gbuffer = in.backend.hostGBuffer();
  const RayCaster& rays = in.services.rays();
  const Sky sky = controls.ofSky == kNone
                      ? Sky()
                      : in.scene.nominalSky.withFactor(
                            controls.controls[static_cast<size_t>(controls.ofSky)].reference);
  struct Seen {
    uint32_t pixel;
    int control;
    vec3 light;
  };
  std::vector<std::vector<Seen>> rows(static_cast<size_t>(gbuffer.height()));
  tbb::parallel_for(0, gbuffer.height(), [&](int y) {
    std::vector<Seen>& row = rows[static_cast<size_t>(y)];
    for (int x = 0; x < gbuffer.width(); ++x) {
      const auto pixel = static_cast<uint32_t>(y * gbuffer.width() + x);
      const vec2 at = vec2(x, y) + 0.5f + jitter;
      const vec3 direction = in.view.rayDirection(at.x, at.y);
      if (!gbuffer.isHit(x, y)) {
        if (controls.ofSky != kNone)
          row.push_back({pixel, controls.ofSky, weight * sky.radianceFrom(direction)});
        continue;
      }
      const uint32_t object = gbuffer.packets().object[gbuffer.packets().index(x, y)];
      if (controls.ofObject[object] == kNone) continue;
      const float znear = in.view.znear / glm::dot(direction, in.view.forward());
      Seen seen{pixel, kNone, vec3(0.0f)};
      seen.light =
          shareSeen(in.scene, rays, {in.view.eye, znear, direction}, controls, seen.control);
      if (seen.control == kNone || seen.light == vec3(0.0f)) continue;
      seen.light *= weight * controls.controls[static_cast<size_t>(seen.control)].reference;
      row.push_back(seen);
    }
  });
  // Merges the lists, which are in the order of pixels.
  std::vector<Pixels> merged(controls.size());
  std::vector<size_t> next(controls.size(), 0);
  const auto keepUntil = [&](size_t control, uint32_t pixel) {
    const Pixels& before = ofControl_[control];
    for (size_t& i = next[control]; i < before.size() && before[i].first < pixel; ++i)
      merged[control].push_back(before[i]);
  };
  for (const std::vector<Seen>& row : rows) {
    for (const Seen& seen : row) {
      const auto control = static_cast<size_t>(seen.control);
      keepUntil(control, seen.pixel);
      merged[control].emplace_back(seen.pixel, seen.light);
      const Pixels& before = ofControl_[control];
      size_t& i = next[control];
      if (i < before.size() && before[i].first == seen.pixel)
        merged[control].back().second += before[i++].second;
    }
  }
  for (size_t control = 0; control < merged.size(); ++control) keepUntil(control, UINT32_MAX);
  ofControl_ = std::move(merged);
}

void EmissionShares::addTo(Image& picture, std::span<const vec3> gains) const {
  for (size_t control = 0; control < ofControl_.size(); ++control) {
    const vec3 gain = gains[control];
    const Pixels& pixels = ofControl_[control];
    tbb::parallel_for(size_t{0}, pixels.size(), [&](size_t i) {
      picture.pixels[pixels[i].first] += gain * pixels[i].second;
    });
  }
}

}  // namespace lamplighter
