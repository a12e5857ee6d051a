#include "editor/assets/asset_folder.h"

#include <algorithm>
#include <sstream>

#include "editor/document/file_kinds.h"
#include "renderer/base/error.h"
#include "renderer/base/text.h"

namespace lamplighter {

namespace {

namespace fs = std::filesystem;

constexpr int kDeepest = 4;
constexpr size_t kMostFiles = 5000;

}  // namespace

std::vector<AssetFile> listAssets(const fs::path& folder) {
  std::vector<AssetFile> files;
  std::error_code error;
  fs::recursive_directory_iterator it(folder, fs::directory_options::skip_permission_denied, error);
  if (error) {
    throw InputError(folder.string(), "cannot be read (" + error.message() + ")",
                     "give a folder of .gltf or .glb files");
  }
  for (const fs::recursive_directory_iterator end; it != end && files.size() < kMostFiles;
       it.increment(error)) {
    if (error) break;
    const fs::path& path = it->path();
    const bool isHidden = path.filename().string().starts_with('.');
    std::error_code ignored;
    if (it->is_directory(ignored)) {
      if (isHidden || it.depth() + 1 >= kDeepest) it.disable_recursion_pending();
      continue;
    }
    if (isHidden || !hasExtension(path, kSceneExtensions)) continue;
    fs::path name = path.lexically_relative(folder);
    files.push_back({path, name.replace_extension().generic_string()});
  }
  std::sort(files.begin(), files.end(), [](const AssetFile& a, const AssetFile& b) {
    return std::pair(a.name, a.path) < std::pair(b.name, b.path);
  });
  return files;
}

std::vector<AssetFile> matchingAssets(const std::vector<AssetFile>& files,
                                      const std::string& text) {
  std::istringstream in(lowerCase(text));
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  std::vector<AssetFile> out;
  for (const AssetFile& file : files) {
    const std::string name = lowerCase(file.name);
    if (std::all_of(words.begin(), words.end(),
                    [&](const std::string& w) { return name.find(w) != std::string::npos; }))
      out.push_back(file);
  }
  return out;
}

}  // namespace lamplighter
