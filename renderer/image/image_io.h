// Reads and writes images with OpenImageIO.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/image/image.h"

namespace lamplighter {

// Reads any format of OpenImageIO as linear floats (EXR unchanged; 8-bit files sRGB-decoded).
// Throws InputError.
Image readImage(const std::filesystem::path& path);

// EXR: 32-bit float RGB, linear radiance, ZIP. PNG: the 8-bit values of `image`, which must be
// display-referred. Atomic (temporary file, then renamed). Throws InputError.
void writeExr(const Image& image, const std::filesystem::path& path);
void writePng(const Image8& image, const std::filesystem::path& path);

// An EXR in memory as writeExr() writes it, with an alpha channel. `pixels`: row 0 is the top; as
// many as width · height. Throws InputError.
std::vector<uint8_t> encodeExr(int width, int height, std::span<const vec4> pixels);

// Encodes an 8-bit RGBA PNG in memory.
std::vector<uint8_t> encodePng(const Image8& image);

// Decodes a PNG, JPEG, … in memory to RGBA without colour conversion. If decoding fails or the
// image is unreasonably large, the result is empty and `why` is set.
std::optional<Image8> decodeImage8(std::span<const uint8_t> bytes, std::string& why);
// The same as linear floats: EXR and HDR unchanged, 8- and 16-bit files sRGB-decoded.
std::optional<Image> decodeImage(std::span<const uint8_t> bytes, std::string& why);
// Whether the header looks like an image that decodeImage8() can decode; sets `why` if not.
bool checkImageHeader(std::span<const uint8_t> bytes, std::string& why);

}  // namespace lamplighter
