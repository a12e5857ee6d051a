// The thread that computes radiance transfer.
#include "renderer/prt/transfers.h"

#include <new>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

class TransfersInBackground : public testing::Test {
 protected:
  int calls_ = 0;
  // The first computations fail.
  int failing_ = 1;
  Transfers transfers_{TransferCache(),
                       [this](const RenderScene& own, const TransferOptions&, TransferProgress*) {
                         if (calls_++ < failing_) throw std::bad_alloc();
                         return std::optional(Transfer{{own.positions.size(), Transfer::Vertex()}});
                       }};
  std::shared_ptr<const RenderScene> own_ = std::make_shared<RenderScene>();

  std::vector<Transfers::Wanted> wanted() const { return {{{1, 0}, own_}, {{2, 0}, own_}}; }
  // As frames do that do not wait.
  void pollUntilDone() const {
    while (transfers_.progress().pending > 0) std::this_thread::yield();
  }
};

TEST_F(TransfersInBackground, HandOverAnExceptionOnceAndGoOn) {
  transfers_.want(wanted(), {});
  pollUntilDone();
  const std::exception_ptr error = transfers_.takeError();
  ASSERT_NE(error, nullptr);
  EXPECT_THROW(std::rethrow_exception(error), std::bad_alloc);
  EXPECT_EQ(transfers_.takeError(), nullptr);
  EXPECT_EQ(calls_, 1);  // the others would fail as well
  EXPECT_EQ(transfers_.find({1, 0}), nullptr);
  EXPECT_EQ(transfers_.find({2, 0}), nullptr);

  transfers_.want(wanted(), {});
  transfers_.wait();
  EXPECT_EQ(transfers_.takeError(), nullptr);
  EXPECT_NE(transfers_.find({1, 0}), nullptr);
  EXPECT_NE(transfers_.find({2, 0}), nullptr);
}

TEST_F(TransfersInBackground, ThrowWhereTheResultIsWaitedFor) {
  transfers_.want(wanted(), {});
  EXPECT_THROW(transfers_.wait(), std::bad_alloc);
  EXPECT_EQ(transfers_.takeError(), nullptr);
}

}  // namespace
}  // namespace lamplighter
