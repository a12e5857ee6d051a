// Distributes jobs of very different sizes over threads.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace lamplighter {

// Each thread takes the next job when it has finished one. If the largest jobs come first, all
// threads finish at about the same time. makeWorker() is called once per thread and returns a
// function of a job's index.
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
