// The kinds of files that the editor reads and writes, by their extensions.
#pragma once

#include <algorithm>
#include <filesystem>
#include <span>
#include <string_view>

#include "renderer/base/text.h"

namespace lamplighter {

using Extensions = std::span<const std::string_view>;  // in lower case, with the dot

inline constexpr std::string_view kSceneExtensions[] = {".gltf", ".glb"};
inline constexpr std::string_view kProfileExtensions[] = {".ies"};
inline constexpr std::string_view kLightPictureExtensions[] = {".png", ".jpg", ".jpeg"};
inline constexpr std::string_view kSkyExtensions[] = {".exr", ".hdr",  ".png",
                                                      ".jpg", ".jpeg", ".webp"};
inline constexpr std::string_view kPngExtensions[] = {".png"};
inline constexpr std::string_view kTimelineExtensions[] = {".json", ".csv"};

// Whether the file has one of the extensions, in upper or lower case.
inline bool hasExtension(const std::filesystem::path& path, Extensions extensions) {
  const std::string own = lowerCase(path.extension().string());
  return std::find(extensions.begin(), extensions.end(), own) != extensions.end();
}

}  // namespace lamplighter
