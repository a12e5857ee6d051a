// A picture on an area light, such as a screen, a window or a lantern. It multiplies the radiance
// of the light.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "renderer/base/math.h"
#include "renderer/image/image.h"

namespace lamplighter {

struct AreaLight;

struct LightPicture {
  std::string file;                                   // file name; the file is in the folder of the
                                                      // scene's file
  std::shared_ptr<const std::vector<uint8_t>> bytes;  // the whole file, saved with the scene
  std::shared_ptr<const Image8> image;                // sRGB-encoded
  uint64_t hash = 0;                                  // of the file's bytes
  // Mean factor, linear: of the whole picture, and of the inscribed ellipse that a disk shows.
  vec3 mean{1.0f}, meanOfDisk{1.0f};

  bool operator==(const LightPicture& o) const { return file == o.file && hash == o.hash; }
};

// Returns null and sets `why` if the bytes are not a picture, or the picture is all black.
std::shared_ptr<const LightPicture> decodeLightPicture(
    std::shared_ptr<const std::vector<uint8_t>> bytes, const std::string& file, std::string& why);
// gltf_light_notes.cpp: the same from a file. Throws InputError.
std::shared_ptr<const LightPicture> readLightPicture(const std::filesystem::path& path);

// The picture that the light shows; null if it has none or its shape cannot show one.
const LightPicture* shownPicture(const AreaLight& light);
// Mean factor over the surface of the light.
vec3 meanFactor(const AreaLight& light);

}  // namespace lamplighter
