// Thumbnails of glTF files as textures. A thread renders them in parallel with the frames, or reads
// them from the cache on disk. Only requested thumbnails are rendered, the last request first.
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
  // Without a cache folder, as in replays, update() renders one thumbnail per frame. Screenshots
  // then do not depend on the timing of a thread.
  void setCacheFolder(std::filesystem::path folder) { cacheFolder_ = std::move(folder); }
  Thumbnails() = default;
  ~Thumbnails();
  Thumbnails(const Thumbnails&) = delete;
  Thumbnails& operator=(const Thumbnails&) = delete;

  struct Thumbnail {
    uint32_t texture = 0;  // 0: not ready yet, or failed
    std::string problem;   // why it failed
  };
  // Needs a current OpenGL context.
  const Thumbnail& get(const std::filesystem::path& file, int size);
  // Call once per frame. Creates textures for the finished thumbnails. Returns true if there are
  // new ones.
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
  std::vector<Name> wanted_;  // next one last; used only by the frames' thread
  std::filesystem::path cacheFolder_;

  std::thread thread_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Name> queue_;  // next one last
  std::vector<Done> done_;
  bool quit_ = false;
};

}  // namespace lamplighter
