#include "tests/support/render.h"

#include <cmath>

#include "renderer/methods/path_tracer/path_tracer.h"

namespace lamplighter::test {

Image renderReference(const Scene& scene, const View& view, int samples, int bounces,
                      uint32_t seed) {
  RenderScene world;
  update(world, scene, SceneChanges::all());
  const RayCaster rays(world);
  const LightSet lights(world);
  Image image(view.width, view.height);
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      for (int i = 0; i < samples; ++i) {
        image.at(x, y) +=
            tracePath(world, rays, lights, view, x, y, static_cast<uint32_t>(i), {bounces, seed});
      }
      image.at(x, y) /= static_cast<float>(samples);
    }
  }
  return image;
}

View lookAt(const vec3& eye, const vec3& target, int width, int height, float yfov) {
  View view;
  view.eye = eye;
  const vec3 back = glm::normalize(eye - target);
  const vec3 up = std::abs(back.y) > 0.999f ? vec3(0, 0, -1) : vec3(0, 1, 0);
  const vec3 right = glm::normalize(glm::cross(up, back));
  view.orientation = glm::normalize(glm::quat_cast(mat3(right, glm::cross(back, right), back)));
  view.yfov = yfov;
  view.width = width;
  view.height = height;
  return view;
}

vec3 meanOf(const Image& image) {
  glm::dvec3 sum(0.0);
  for (const vec3& p : image.pixels) sum += glm::dvec3(p);
  return vec3(sum / static_cast<double>(image.pixels.size()));
}

double polygonFormFactor(const vec3& x, const vec3& n, const std::vector<vec3>& polygon) {
  double sum = 0.0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3 a = glm::normalize(glm::dvec3(polygon[i]) - glm::dvec3(x));
    const glm::dvec3 b =
        glm::normalize(glm::dvec3(polygon[(i + 1) % polygon.size()]) - glm::dvec3(x));
    const glm::dvec3 axis = glm::cross(a, b);
    const double length = glm::length(axis);
    if (length <= 0.0) continue;
    sum += std::atan2(length, glm::dot(a, b)) * glm::dot(axis / length, glm::dvec3(n));
  }
  return std::abs(sum) / (2.0 * 3.14159265358979323846);
}

}  // namespace lamplighter::test
