// Reading and writing images, through OpenImageIO.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/image/image.h"

namespace lamplighter {

// Any format that OpenImageIO reads, as linear floats (EXR as it is; 8-bit files sRGB-decoded).
// Throws InputError.
Image readImage(const std::filesystem::path& path);

// EXR: 32-bit float RGB, linear radiance, ZIP. PNG and others: 8 bits as they are in `image`, which
// must be display-referred already. Atomic (temporary file, then renamed). Throws InputError.
void writeExr(const Image& image, const std::filesystem::path& path);
void writePng(const Image8& image, const std::filesystem::path& path);

// The bytes of a PNG, 8 bits RGBA.
std::vector<uint8_t> encodePng(const Image8& image);

// Decodes a PNG, JPEG, … in memory, as encoded (no colour conversion), RGBA. Empty and `why` set
// when it cannot be decoded or is unreasonably large.
std::optional<Image8> decodeImage8(std::span<const uint8_t> bytes, std::string& why);
// The same as linear floats: EXR and HDR as they are, 8- and 16-bit files sRGB-decoded.
std::optional<Image> decodeImage(std::span<const uint8_t> bytes, std::string& why);
// Whether the bytes begin as an image that decodeImage8() might decode; `why` set when not.
bool checkImageHeader(std::span<const uint8_t> bytes, std::string& why);

}  // namespace lamplighter
