// What is seen where a ray meets nothing, and lights the scene from all round: a colour, a gradient
// or a picture. Small and cheap to copy: pixels are shared and never change.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "renderer/base/math.h"
#include "renderer/image/image.h"
#include "renderer/scene/sky_map.h"

namespace lamplighter {

// The brightest that a picture's pixel may be, and a sky's colour [W/(m² sr)]: 2/3 of the real sun.
inline constexpr float kMostRadiance = 1e9f;

// An equirectangular picture of the whole sphere (shaders/shared/sky.h says which pixel is where)
// with what its sampling needs, all found once.
struct SkyImage {
  Image pixels;      // radiance [W/(m² sr)] at scale 1; finite, none below 0
  SkyMap map;        // of those
  std::string name;  // of its file, without the folder
  std::shared_ptr<const std::vector<uint8_t>> file;  // as read, to be saved again; null: there is
                                                     // none
  uint64_t hash = 0;                                 // of the file's bytes, or of the pixels
};

enum class SkyKind : uint8_t { constant, gradient, image };

// What is not of its kind keeps its default value, so that equal skies look the same.
struct Sky {
  SkyKind kind = SkyKind::constant;
  vec3 radiance{0.0f};  // constant [W/(m² sr)]
  // gradient [W/(m² sr)]: skyGradient() of shaders/shared/sky.h
  vec3 zenith{0.0f}, horizon{0.0f}, ground{0.0f};
  std::shared_ptr<const SkyImage> image;  // image: never null
  float rotation = 0.0f;                  // image: about Y [rad]
  float scale = 1.0f;                     // image: multiplies its pixels

  Sky() = default;
  Sky(const vec3& constant) : radiance(constant) {}  // implicit: a colour is a sky
  static Sky gradient(const vec3& zenith, const vec3& horizon, const vec3& ground);
  static Sky picture(std::shared_ptr<const SkyImage> image, float rotation = 0.0f,
                     float scale = 1.0f);

  // What comes from a unit direction [W/(m² sr)]; pictures are interpolated between pixels.
  vec3 radianceFrom(const vec3& towards) const;
  // No light comes from it.
  bool isBlack() const;
  bool operator==(const Sky& other) const;
};

// What is no finite number, or below 0, becomes 0. Pictures wider than 4096 pixels are halved until
// they are not. `file`: what they were read from, if anything. Throws InputError for an empty one.
std::shared_ptr<const SkyImage> makeSkyImage(
    Image pixels, std::string name, std::shared_ptr<const std::vector<uint8_t>> file = nullptr);

// From the bytes of an EXR, HDR or any other file that decodeImage() takes. Null and `why` set when
// it is none.
std::shared_ptr<const SkyImage> decodeSkyImage(std::shared_ptr<const std::vector<uint8_t>> file,
                                               const std::string& name, std::string& why);

// gltf_sky.cpp: from a file. Throws InputError.
std::shared_ptr<const SkyImage> readSkyImage(const std::filesystem::path& path);

}  // namespace lamplighter
