#include "renderer/scene/light_picture.h"

#include <array>
#include <cmath>

#include "renderer/base/hash.h"
#include "renderer/image/image_io.h"
#include "renderer/scene/scene.h"

namespace lamplighter {

namespace {

// sRGB decoding (IEC 61966-2-1).
double decoded(uint8_t value) {
  const double v = value / 255.0;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

// Means of the texels: bilinear filtering with clamped borders has the same mean.
void findMeans(LightPicture& picture) {
  std::array<double, 256> linear;
  for (size_t i = 0; i < linear.size(); ++i) linear[i] = decoded(static_cast<uint8_t>(i));
  const Image8& image = *picture.image;
  glm::dvec3 all(0.0), within(0.0);
  size_t inDisk = 0;
  for (int y = 0; y < image.height; ++y) {
    const double v = 2.0 * (y + 0.5) / image.height - 1.0;
    for (int x = 0; x < image.width; ++x) {
      const double u = 2.0 * (x + 0.5) / image.width - 1.0;
      const uint8_t* texel = image.at(x, y);
      const glm::dvec3 factor(linear[texel[0]], linear[texel[1]], linear[texel[2]]);
      all += factor;
      if (u * u + v * v > 1.0) continue;
      within += factor;
      ++inDisk;
    }
  }
  picture.mean = vec3(all / (static_cast<double>(image.width) * image.height));
  picture.meanOfDisk = inDisk > 0 ? vec3(within / static_cast<double>(inDisk)) : picture.mean;
}

}  // namespace

std::shared_ptr<const LightPicture> decodeLightPicture(
    std::shared_ptr<const std::vector<uint8_t>> bytes, const std::string& file, std::string& why) {
  auto image = decodeImage8(*bytes, why);
  if (!image) return nullptr;
  auto picture = std::make_shared<LightPicture>();
  picture->file = file;
  picture->image = std::make_shared<const Image8>(std::move(*image));
  picture->hash = hashOfBytes(*bytes);
  picture->bytes = std::move(bytes);
  findMeans(*picture);
  if (luminance(picture->mean) > 0.0f && luminance(picture->meanOfDisk) > 0.0f) return picture;
  why = "is all black";
  return nullptr;
}

const LightPicture* shownPicture(const AreaLight& light) {
  const bool shows = light.shape == AreaShape::rectangle || light.shape == AreaShape::disk;
  return shows ? light.picture.get() : nullptr;
}

vec3 meanFactor(const AreaLight& light) {
  const LightPicture* picture = shownPicture(light);
  if (picture == nullptr) return vec3(1.0f);
  return light.shape == AreaShape::disk ? picture->meanOfDisk : picture->mean;
}

}  // namespace lamplighter
