// Loads a scene on a thread of its own, so that the window stays alive meanwhile.
#pragma once

#include <atomic>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter {

class SceneLoader {
 public:
  ~SceneLoader();

  struct Result {
    std::filesystem::path path;
    std::optional<LoadedScene> loaded;
    std::string error;  // why there is none; empty when it was cancelled
  };

  // Ends what is running and loads this.
  void start(const std::filesystem::path& path);
  bool running() const { return thread_.joinable(); }
  void cancel() { cancelled_ = true; }
  float done() const { return done_; }
  std::string what() const;
  // What came of it, once, when it is there.
  std::optional<Result> take();

 private:
  void load(const std::filesystem::path& path);

  std::thread thread_;
  std::atomic<bool> cancelled_ = false, finished_ = false;
  std::atomic<float> done_ = 0.0f;
  mutable std::mutex mutex_;  // guards what_
  std::string what_;
  Result result_;  // written by the thread until finished_
};

}  // namespace lamplighter
