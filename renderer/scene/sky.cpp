#include "renderer/scene/sky.h"

#include <algorithm>

#include "renderer/base/error.h"
#include "renderer/base/hash.h"
#include "renderer/image/image_io.h"
#include "shaders/shared/sky.h"

namespace lamplighter {

namespace {

constexpr int kMostWidth = 4096;

// Halves width and height; each pixel is the mean of up to four.
Image halved(const Image& image) {
  Image out((image.width + 1) / 2, (image.height + 1) / 2);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const int x1 = std::min(2 * x + 1, image.width - 1),
                y1 = std::min(2 * y + 1, image.height - 1);
      out.at(x, y) = 0.25f * (image.at(2 * x, 2 * y) + image.at(x1, 2 * y) + image.at(2 * x, y1) +
                              image.at(x1, y1));
    }
  }
  return out;
}

vec3 interpolated(const Image& image, const vec2& at) {
  const vec2 p = at * vec2(image.width, image.height) - 0.5f;
  const vec2 base = glm::floor(p), t = p - base;
  const int x = static_cast<int>(base.x), y = static_cast<int>(base.y);
  const int x0 = (x + image.width) % image.width, x1 = (x + 1) % image.width;
  const int y0 = std::max(y, 0), y1 = std::min(y + 1, image.height - 1);
  return glm::mix(glm::mix(image.at(x0, y0), image.at(x1, y0), t.x),
                  glm::mix(image.at(x0, y1), image.at(x1, y1), t.x), t.y);
}

}  // namespace

Sky Sky::gradient(const vec3& zenith, const vec3& horizon, const vec3& ground) {
  Sky sky;
  sky.kind = SkyKind::gradient;
  sky.zenith = zenith;
  sky.horizon = horizon;
  sky.ground = ground;
  return sky;
}

Sky Sky::picture(std::shared_ptr<const SkyImage> image, float rotation, float scale) {
  Sky sky;
  sky.kind = SkyKind::image;
  sky.image = std::move(image);
  sky.rotation = rotation;
  sky.scale = scale;
  return sky;
}

vec3 Sky::radianceFrom(const vec3& towards) const {
  switch (kind) {
    case SkyKind::constant:
      return radiance;
    case SkyKind::gradient:
      return shared::skyGradient(zenith, horizon, ground, towards.y);
    case SkyKind::image:
      break;
  }
  return scale * interpolated(image->pixels, shared::skyCoordinates(towards, rotation));
}

bool Sky::isBlack() const {
  switch (kind) {
    case SkyKind::constant:
      return !(luminance(radiance) > 0.0f);
    case SkyKind::gradient:
      return !(luminance(zenith + horizon + ground) > 0.0f);
    case SkyKind::image:
      break;
  }
  const SkyMap& map = image->map;
  return !(scale > 0.0f) || (!(luminance(map.irradiance()) > 0.0f) && map.suns().empty());
}

vec3 Sky::factor() const {
  switch (kind) {
    case SkyKind::constant:
      return radiance;
    case SkyKind::gradient:
      return vec3(1.0f);
    case SkyKind::image:
      break;
  }
  return vec3(scale);
}

Sky Sky::withFactor(float factor) const {
  Sky sky = *this;
  if (kind == SkyKind::constant) sky.radiance = vec3(factor);
  if (kind == SkyKind::image) sky.scale = factor;
  return sky;
}

bool Sky::operator==(const Sky& o) const {
  const bool sameImage = image == o.image || (image && o.image && image->hash == o.image->hash &&
                                              image->pixels.width == o.image->pixels.width &&
                                              image->pixels.height == o.image->pixels.height);
  return kind == o.kind && radiance == o.radiance && zenith == o.zenith && horizon == o.horizon &&
         ground == o.ground && sameImage && rotation == o.rotation && scale == o.scale;
}

std::shared_ptr<const SkyImage> makeSkyImage(Image pixels, std::string name,
                                             std::shared_ptr<const std::vector<uint8_t>> file) {
  if (pixels.empty()) throw InputError(name, "is an empty picture", "choose another picture");
  for (vec3& p : pixels.pixels) {
    for (int c = 0; c < 3; ++c) p[c] = p[c] > 0.0f ? std::min(p[c], kMostRadiance) : 0.0f;
  }
  while (pixels.width > kMostWidth) pixels = halved(pixels);
  auto image = std::make_shared<SkyImage>();
  image->map = SkyMap(pixels);
  image->name = std::move(name);
  image->hash = file ? hashOfBytes(*file) : hashOfBytes(pixels.pixels);
  image->pixels = std::move(pixels);
  image->file = std::move(file);
  return image;
}

std::shared_ptr<const SkyImage> decodeSkyImage(std::shared_ptr<const std::vector<uint8_t>> file,
                                               const std::string& name, std::string& why) {
  std::optional<Image> pixels = decodeImage(*file, why);
  if (!pixels) return nullptr;
  return makeSkyImage(std::move(*pixels), name, std::move(file));
}

}  // namespace lamplighter
