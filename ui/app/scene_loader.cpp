#include "ui/app/scene_loader.h"

#include <utility>

#include "editor/notices/failure_text.h"

namespace lamplighter {

SceneLoader::~SceneLoader() {
  cancelled_ = true;
  if (thread_.joinable()) thread_.join();
}

void SceneLoader::start(const std::filesystem::path& path) {
  cancelled_ = true;
  if (thread_.joinable()) thread_.join();
  cancelled_ = finished_ = false;
  done_ = 0.0f;
  what_.clear();
  result_ = {};
  result_.path = path;
  thread_ = std::thread([this, path] { load(path); });
}

void SceneLoader::load(const std::filesystem::path& path) {
  std::optional<LoadedScene> loaded;
  std::string error;
  try {
    loaded = loadGltf(path, [this](float done, const std::string& what) {
      done_ = done;
      const std::lock_guard lock(mutex_);
      what_ = what;
      return !cancelled_;
    });
  } catch (const std::exception& e) {
    error = failureText(e);
  }
  if (cancelled_) {
    loaded.reset();
    error.clear();
  }
  result_.loaded = std::move(loaded);
  result_.error = std::move(error);
  finished_ = true;
}

std::string SceneLoader::what() const {
  const std::lock_guard lock(mutex_);
  return what_;
}

std::optional<SceneLoader::Result> SceneLoader::take() {
  if (!finished_) return std::nullopt;
  thread_.join();
  finished_ = false;
  return std::move(result_);
}

}  // namespace lamplighter
