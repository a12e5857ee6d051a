#include "editor/assets/asset_library.h"

#include <algorithm>

#include "renderer/base/error.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/gltf/referenced_files.h"

namespace lamplighter {

namespace fs = std::filesystem;

std::shared_ptr<const ClipboardFragment> AssetLibrary::load(const fs::path& file) {
  std::error_code error;
  const fs::path path = fs::absolute(file, error).lexically_normal();
  fs::file_time_type time = fs::last_write_time(path, error);
  uintmax_t size = error ? 0 : fs::file_size(path, error);
  for (const FileStamp& stamp : referencedFiles(path)) {
    std::error_code gone;
    if (const auto theirs = fs::last_write_time(stamp.path, gone); !gone)
      time = std::max(time, theirs);
    size += stamp.size;
  }
  const auto it = std::find_if(entries_.begin(), entries_.end(),
                               [&](const Entry& e) { return e.file == path; });
  if (it != entries_.end()) {
    if (!error && it->time == time && it->size == size) {
      entries_.splice(entries_.begin(), entries_, it);
      return entries_.front().fragment;
    }
    entries_.erase(it);
  }
  const LoadedScene loaded = loadGltf(path);
  std::vector<NodeId> roots;
  for (const Node& n : loaded.scene.nodes)
    if (n.parent == kNoNode) roots.push_back(n.id);
  auto fragment = std::make_shared<const ClipboardFragment>(clip(loaded.scene, roots));
  if (fragment->meshes.empty() &&
      std::none_of(fragment->nodes.begin(), fragment->nodes.end(),
                   [](const Node& n) { return n.area || n.punctual; })) {
    throw InputError(file.string(), "contains nothing to place",
                     "give a file with a mesh or a light");
  }
  entries_.push_front({path, time, size, fragment});
  if (entries_.size() > kMost) entries_.pop_back();
  return fragment;
}

}  // namespace lamplighter
