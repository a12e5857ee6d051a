// The folder of cached data.
#include "editor/document/cache_folder.h"

#include <cstdlib>
#include <optional>
#include <string>

#include <gtest/gtest.h>

namespace lamplighter {
namespace {

// Sets or unsets an environment variable, and restores it at the end.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    set(value);
  }
  ~Variable() { set(before_ ? before_->c_str() : nullptr); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  void set(const char* value) {
    if (value != nullptr) {
      setenv(name_, value, 1);
    } else {
      unsetenv(name_);
    }
  }
  const char* name_;
  std::optional<std::string> before_;
};

TEST(TransferFolder, FollowsTheXdgSpecification) {
  const Variable home("HOME", "/home/someone");
  {
    const Variable cache("XDG_CACHE_HOME", "/var/cache/someone");
    EXPECT_EQ(transferFolder(), "/var/cache/someone/lamplighter/transfer");
  }
  for (const char* invalid : {"", "relative"}) {
    const Variable cache("XDG_CACHE_HOME", invalid);
    EXPECT_EQ(transferFolder(), "/home/someone/.cache/lamplighter/transfer");
  }
}

TEST(TransferFolder, IsEmptyWithoutAHomeFolder) {
  const Variable home("HOME", nullptr), cache("XDG_CACHE_HOME", nullptr);
  EXPECT_EQ(transferFolder(), "");
}

}  // namespace
}  // namespace lamplighter
