// Jobs of very different sizes, shared out among threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace lamplighter {

// Each thread takes the next job whenever it is done with one, so that where the largest come first
// all are done at about the same time. makeWorker(): a function of a job's index, one for a thread.
template <typename MakeWorker>
void doInTurn(size_t jobs, const MakeWorker& makeWorker) {
  std::atomic<size_t> next = 0;
  const auto threads = static_cast<size_t>(tbb::this_task_arena::max_concurrency());
  tbb::parallel_for(
      size_t{0}, std::min(jobs, threads),
      [&](size_t) {
        auto worker = makeWorker();
        for (size_t i = next++; i < jobs; i = next++) worker(i);
      },
      tbb::simple_partitioner());
}

}  // namespace lamplighter
