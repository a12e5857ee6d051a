// Thumbnails of glTF files as textures: rendered on a thread beside the frames, or from the cache
// on disk; only what is asked for, the last asked for first.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "renderer/gl/objects.h"
#include "renderer/image/image.h"

namespace lamplighter {

class Thumbnails {
 public:
  // Without a cache folder, as in replays, all are rendered: one a frame, within update(), so that
  // a picture of the window does not hang on a thread's pace.
  void setCacheFolder(std::filesystem::path folder) { cacheFolder_ = std::move(folder); }
  Thumbnails() = default;
  ~Thumbnails();
  Thumbnails(const Thumbnails&) = delete;
  Thumbnails& operator=(const Thumbnails&) = delete;

  struct Thumbnail {
    uint32_t texture = 0;  // 0: not there yet, or there will be none
    std::string problem;   // why there is none
  };
  // Needs a current OpenGL context.
  const Thumbnail& get(const std::filesystem::path& file, int size);
  // Once a frame: makes textures of what was rendered since. True when there are new ones.
  bool update();
  bool busy() const { return !wanted_.empty(); }

 private:
  using Name = std::pair<std::filesystem::path, int>;
  struct Done {
    Name name;
    std::optional<Image8> image;
    std::string problem;
  };
  static Done make(const Name& name, const std::filesystem::path& cacheFolder);
  void show(const Done& done);
  void run();

  struct Entry {
    Thumbnail thumbnail;
    gl::Texture texture;
  };
  std::map<Name, Entry> entries_;
  std::vector<Name> wanted_;  // the next one last; the frames' own list
  std::filesystem::path cacheFolder_;

  std::thread thread_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Name> queue_;  // the next one last
  std::vector<Done> done_;
  bool quit_ = false;
};

}  // namespace lamplighter
