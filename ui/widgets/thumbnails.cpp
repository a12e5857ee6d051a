#include "ui/widgets/thumbnails.h"

#include <exception>

#include <tbb/task_arena.h>

#include "editor/assets/thumbnail.h"
#include "editor/notices/failure_text.h"

namespace lamplighter {

Thumbnails::~Thumbnails() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    quit_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

Thumbnails::Done Thumbnails::make(const Name& name, const std::filesystem::path& cacheFolder) {
  Done done{name, std::nullopt, ""};
  try {
    done.image = cachedThumbnail(name.first, name.second, cacheFolder);
  } catch (const std::exception& e) {  // a file that cannot be opened has no thumbnail
    done.problem = failureText(e);
  }
  return done;
}

const Thumbnails::Thumbnail& Thumbnails::get(const std::filesystem::path& file, int size) {
  const auto [it, isNew] = entries_.try_emplace({file, size});
  if (isNew) {
    wanted_.insert(wanted_.begin(), it->first);
    if (!cacheFolder_.empty()) {
      const std::lock_guard lock(mutex_);
      queue_.insert(queue_.begin(), it->first);
      if (!thread_.joinable()) thread_ = std::thread([this] { run(); });
      changed_.notify_one();
    }
  }
  return it->second.thumbnail;
}

bool Thumbnails::update() {
  std::vector<Done> done;
  if (cacheFolder_.empty()) {
    if (!wanted_.empty()) done.push_back(make(wanted_.back(), {}));
  } else {
    const std::lock_guard lock(mutex_);
    done.swap(done_);
  }
  for (const Done& d : done) show(d);
  return !done.empty();
}

void Thumbnails::show(const Done& done) {
  std::erase(wanted_, done.name);
  Entry& entry = entries_[done.name];
  entry.thumbnail.problem = done.problem;
  if (!done.image) return;
  const Image8& image = *done.image;
  entry.texture = gl::makeTexture2D(GL_RGBA8, image.width, image.height, GL_LINEAR);
  glTextureSubImage2D(entry.texture.name(), 0, 0, 0, image.width, image.height, GL_RGBA,
                      GL_UNSIGNED_BYTE, image.pixels.data());
  entry.thumbnail.texture = entry.texture.name();
}

void Thumbnails::run() {
  // One core at low priority, so that frames are not delayed.
  tbb::task_arena beside(1, 1, tbb::task_arena::priority::low);
  for (;;) {
    Name name;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [&] { return quit_ || !queue_.empty(); });
      if (quit_) return;
      name = queue_.back();
      queue_.pop_back();
    }
    Done done;
    beside.execute([&] { done = make(name, cacheFolder_); });
    const std::lock_guard lock(mutex_);
    done_.push_back(std::move(done));
  }
}

}  // namespace lamplighter
