// Loads a scene on its own thread, so that the window stays responsive.
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
    std::string error;  // reason of a failure; empty if cancelled
  };

  // Cancels a load in progress and starts a new one.
  void start(const std::filesystem::path& path);
  bool running() const { return thread_.joinable(); }
  void cancel() { cancelled_ = true; }
  float done() const { return done_; }
  std::string what() const;
  // The result, once, when loading has finished.
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
