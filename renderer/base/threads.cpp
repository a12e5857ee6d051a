#include "renderer/base/threads.h"

#include <tbb/global_control.h>

namespace lamplighter {

struct ThreadLimit::Impl {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads <= 0) return;
  impl_ = std::unique_ptr<Impl>(new Impl{tbb::global_control(
      tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads))});
}

ThreadLimit::~ThreadLimit() = default;

}  // namespace lamplighter
