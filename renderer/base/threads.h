// How many threads the parallel parts may use; the results do not depend on it.
#pragma once

#include <memory>

namespace lamplighter {

// Holds all parallel work to `threads` while it lives; 0: as many as there are cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace lamplighter
