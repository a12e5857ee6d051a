// Limits the number of threads. Results do not depend on it.
#pragma once

#include <memory>

namespace lamplighter {

// Limits all parallel work to `threads` threads during its lifetime; 0: one per core.
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
