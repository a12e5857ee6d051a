#include "tests/support/scenes/skies.h"

#include <cmath>

#include "renderer/image/image_io.h"

namespace lamplighter::test {

namespace {

vec3 directionOf(double azimuth, double height) {
  const double r = std::sqrt(1.0 - height * height);
  return vec3(r * std::sin(azimuth), height, -r * std::cos(azimuth));
}

// ∫ f(direction) dω over the sphere.
template <typename F>
vec3 integral(F f) {
  constexpr int kColumns = 2880, kRows = 1440;
  glm::dvec3 sum(0.0);
  for (int y = 0; y < kRows; ++y) {
    for (int x = 0; x < kColumns; ++x) {
      sum += glm::dvec3(f(directionOf(2.0 * static_cast<double>(kPi) * (x + 0.5) / kColumns,
                                      2.0 * (y + 0.5) / kRows - 1.0)));
    }
  }
  return vec3(sum * (4.0 * static_cast<double>(kPi) / (kColumns * kRows)));
}

}  // namespace

Sky gradientSky() {
  return Sky::gradient(vec3(0.2f, 0.5f, 1.2f), vec3(1.5f, 1.3f, 1.1f), vec3(0.3f, 0.2f, 0.1f));
}

Sky cloudySky() {
  Image image(64, 32);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const float a = 2.0f * kPi * static_cast<float>(x) / 64.0f,
                  b = kPi * static_cast<float>(y) / 32.0f;
      image.at(x, y) = vec3(1.0f + 0.8f * std::sin(a), 1.2f + std::cos(2.0f * a + b),
                            0.5f + 0.4f * std::sin(3.0f * b));
    }
  }
  return Sky::picture(makeSkyImage(std::move(image), "cloudy.exr"));
}

Sky sunnySky() {
  Image image(720, 360);
  const float elevation = 40.0f / 180.0f * kPi;
  const vec3 sun(std::cos(elevation), std::sin(elevation), 0.0f);
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const double polar = static_cast<double>(kPi) * (y + 0.5) / image.height;
      const vec3 d = directionOf(2.0 * static_cast<double>(kPi) * ((x + 0.5) / image.width - 0.5),
                                 std::cos(polar));
      image.at(x, y) = d.y > 0.0f ? vec3(0.3f, 0.5f, 0.9f) : vec3(0.1f, 0.08f, 0.05f);
      if (glm::dot(d, sun) > std::cos(0.5f / 180.0f * kPi))
        image.at(x, y) = vec3(30000.0f, 25000.0f, 18000.0f);
    }
  }
  return Sky::picture(makeSkyImage(std::move(image), "sunny.exr"));
}

vec3 irradianceOn(const Sky& sky, const vec3& normal) {
  return integral(
      [&](const vec3& d) { return std::max(0.0f, glm::dot(d, normal)) * sky.radianceFrom(d); });
}

vec3 irradianceOfAll(const Sky& sky) {
  return integral([&](const vec3& d) { return sky.radianceFrom(d); });
}

std::shared_ptr<const SkyImage> throughFile(const Image& pixels,
                                            const std::filesystem::path& file) {
  writeExr(pixels, file);
  return readSkyImage(file);
}

}  // namespace lamplighter::test
