// The transfer of the objects of a scene, computed on a separate thread while frames continue.
#pragma once

#include <condition_variable>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "renderer/prt/transfer_cache.h"

namespace lamplighter {

class Transfers {
 public:
  struct Wanted {
    TransferKey key;
    std::shared_ptr<const RenderScene> own;  // from ownSceneOf()
  };

  // computeTransfer(), or the replacement of a test.
  using Compute = std::function<std::optional<Transfer>(
      const RenderScene& own, const TransferOptions& options, TransferProgress* progress)>;

  explicit Transfers(TransferCache cache = TransferCache(), Compute compute = computeTransfer)
      : cache_(std::move(cache)), compute_(std::move(compute)) {}
  ~Transfers();  // cancels
  Transfers(const Transfers&) = delete;
  Transfers& operator=(const Transfers&) = delete;

  // Sets all transfers that are needed now, in the order of loading or computing. Transfers that
  // are no longer needed are discarded, and cancelled if they are being computed.
  void want(std::vector<Wanted> wanted, const TransferOptions& options);

  // Null if it is not ready.
  std::shared_ptr<const Transfer> find(const TransferKey& key) const;
  // Waits until all are ready. Throws the exception of the computation.
  void wait();
  // The exception of the computation since the last call; null: there was none. The rest of the
  // queue is discarded.
  std::exception_ptr takeError();

  struct Progress {
    size_t pending = 0;  // number of transfers
    float share = 1.0f;  // of the vertices of the transfer that is being computed
  };
  Progress progress() const;

 private:
  void work();

  const TransferCache cache_;
  const Compute compute_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  // Protected by the mutex:
  std::map<TransferKey, std::shared_ptr<const Transfer>> ready_;
  std::vector<Wanted> queue_;  // the next one is the last element
  TransferOptions options_;
  std::shared_ptr<TransferProgress> current_;  // null: none is running
  TransferKey currentKey_{};
  std::exception_ptr error_;

  std::thread thread_;  // runs while the queue is not empty
  bool isRunning_ = false;
};

}  // namespace lamplighter
