// The sky: what a ray sees if it hits nothing; it lights the scene from all directions. A colour, a
// gradient or a picture. Small and cheap to copy: pixels are shared and immutable.
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

// Upper limit of a sky's colour and of the pixels of its picture [W/(m² sr)]: 2/3 of the real sun.
inline constexpr float kMostRadiance = 1e9f;

// An equirectangular picture of the whole sphere (mapping: shaders/shared/sky.h) with the tables
// for sampling it, all computed once.
struct SkyImage {
  Image pixels;      // radiance [W/(m² sr)] at scale 1; finite, ≥ 0
  SkyMap map;        // of the pixels
  std::string name;  // file name, without the folder
  std::shared_ptr<const std::vector<uint8_t>> file;  // as read, saved with the scene; null: no file
  uint64_t hash = 0;                                 // of the file's bytes, or of the pixels
};

enum class SkyKind : uint8_t { constant, gradient, image };

// Members of other kinds keep their default values, so that equal skies compare equal.
struct Sky {
  SkyKind kind = SkyKind::constant;
  vec3 radiance{0.0f};  // constant [W/(m² sr)]
  // gradient [W/(m² sr)]: skyGradient() of shaders/shared/sky.h
  vec3 zenith{0.0f}, horizon{0.0f}, ground{0.0f};
  std::shared_ptr<const SkyImage> image;  // image: never null
  float rotation = 0.0f;                  // image: around Y [rad]
  float scale = 1.0f;                     // image: multiplies its pixels

  Sky() = default;
  Sky(const vec3& constant) : radiance(constant) {}  // implicit: a colour is a sky
  static Sky gradient(const vec3& zenith, const vec3& horizon, const vec3& ground);
  static Sky picture(std::shared_ptr<const SkyImage> image, float rotation = 0.0f,
                     float scale = 1.0f);

  // Radiance from a unit direction [W/(m² sr)]; pictures are interpolated bilinearly.
  vec3 radianceFrom(const vec3& towards) const;
  // Whether it gives no light.
  bool isBlack() const;
  // What multiplies the light of the sky: its colour, or the scale of its picture. 1 for gradients.
  vec3 factor() const;
  // The same sky with another factor. Gradients do not change.
  Sky withFactor(float factor) const;
  bool operator==(const Sky& other) const;
};

// Pixels that are not finite or negative become 0. Pictures wider than 4096 pixels are halved until
// they are not. `file`: the bytes they were read from, or null. Throws InputError for an empty
// picture.
std::shared_ptr<const SkyImage> makeSkyImage(
    Image pixels, std::string name, std::shared_ptr<const std::vector<uint8_t>> file = nullptr);

// Decodes an EXR, HDR or any other file of decodeImage(). If that fails, returns null and sets
// `why`.
std::shared_ptr<const SkyImage> decodeSkyImage(std::shared_ptr<const std::vector<uint8_t>> file,
                                               const std::string& name, std::string& why);

// gltf_sky.cpp: from a file. Throws InputError.
std::shared_ptr<const SkyImage> readSkyImage(const std::filesystem::path& path);

}  // namespace lamplighter
