// A cache of the props that were read from files. A prop that is placed again is not read again.
// Its meshes and pixels are shared with the levels that use it.
#pragma once

#include <filesystem>
#include <list>
#include <memory>

#include "editor/edits/clipboard_fragment.h"

namespace lamplighter {

class AssetLibrary {
 public:
  // Returns the whole scene of the file. Reads the file again if it, or a file that it references,
  // has changed. Throws InputError.
  std::shared_ptr<const ClipboardFragment> load(const std::filesystem::path& file);

 private:
  static constexpr size_t kMost = 32;  // number of most recently used assets to keep
  struct Entry {
    std::filesystem::path file;
    std::filesystem::file_time_type time;  // newest time of the file and the files it references
    uintmax_t size = 0;                    // total size of these files
    std::shared_ptr<const ClipboardFragment> fragment;
  };
  std::list<Entry> entries_;  // most recently used first
};

}  // namespace lamplighter
