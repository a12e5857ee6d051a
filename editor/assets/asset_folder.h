// Folders of glTF files to place from.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lamplighter {

struct AssetFile {
  std::filesystem::path path;
  std::string name;  // below the folder, without its ending: "props/barrel_large"
};

// The .gltf and .glb files of a folder and of those in it, by name; hidden ones are left out, and
// so is what lies deeper than four folders or comes after the first 5000 files. Throws InputError
// where the folder cannot be read.
std::vector<AssetFile> listAssets(const std::filesystem::path& folder);

// Those whose names hold every word of the text, in any case.
std::vector<AssetFile> matchingAssets(const std::vector<AssetFile>& files, const std::string& text);

}  // namespace lamplighter
