// Props that were read, to be placed again without reading them: their meshes and pixels are shared
// with the levels they were placed in.
#pragma once

#include <filesystem>
#include <list>
#include <memory>

#include "editor/edits/clipboard_fragment.h"

namespace lamplighter {

class AssetLibrary {
 public:
  // The whole of the file's scene. Read anew where it or a file that it names changed. Throws
  // InputError.
  std::shared_ptr<const ClipboardFragment> load(const std::filesystem::path& file);

 private:
  static constexpr size_t kMost = 32;  // the last used
  struct Entry {
    std::filesystem::path file;
    std::filesystem::file_time_type time;  // of it and the files that it names: the newest
    uintmax_t size = 0;                    // and all together
    std::shared_ptr<const ClipboardFragment> fragment;
  };
  std::list<Entry> entries_;  // the last used first
};

}  // namespace lamplighter
