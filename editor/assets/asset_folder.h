// Folders of glTF files that the user can place in a level.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lamplighter {

struct AssetFile {
  std::filesystem::path path;
  std::string name;  // path relative to the folder, without extension: "props/barrel_large"
};

// Lists the .gltf and .glb files of a folder and its subfolders, sorted by name. Leaves out hidden
// files, files more than four folders deep, and everything after the first 5000 files. Throws
// InputError if the folder cannot be read.
std::vector<AssetFile> listAssets(const std::filesystem::path& folder);

// The files whose names contain every word of the text, ignoring case.
std::vector<AssetFile> matchingAssets(const std::vector<AssetFile>& files, const std::string& text);

}  // namespace lamplighter
