#include "editor/explain/probe.h"

#include <cmath>

#include "editor/explain/quantity.h"

namespace lamplighter {

Reading probe(const Scene& scene, const RenderScene& world, const RayCaster& rays, const View& view,
              const vec2& pixel, const LightSamples& samples, const Image* picture) {
  Reading r;
  r.pixel = pixel;
  r.object = "sky";
  if (const auto point = surfaceAt(world, rays, view, pixel)) {
    const Node* node = scene.find(point->node);
    r.object = node == nullptr || node->name.empty() ? "(unnamed)" : node->name;
    r.lux = irradianceAt(rays, *point, samples);
    r.distance = glm::length(point->position - view.eye);
  }
  const auto x = static_cast<int>(std::floor(pixel.x)), y = static_cast<int>(std::floor(pixel.y));
  if (picture != nullptr && x >= 0 && y >= 0 && x < picture->width && y < picture->height)
    r.nits = luminance(picture->at(x, y));
  return r;
}

std::string readingText(const Reading& r) {
  std::string text = r.object + ":";
  std::string comma = " ";
  const auto add = [&](const std::string& part) {
    text += comma + part;
    comma = ", ";
  };
  if (r.lux) add(luxText(*r.lux));
  if (r.nits) add(nitsText(*r.nits));
  if (r.distance) add(metresText(*r.distance) + " away");
  return text;
}

}  // namespace lamplighter
