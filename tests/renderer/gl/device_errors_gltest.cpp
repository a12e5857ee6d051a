// What OpenGL says of the device becomes an exception, once.
#include <deque>
#include <utility>

#include <gtest/gtest.h>

#include "renderer/backends/backend.h"
#include "renderer/gl/debug.h"

namespace lamplighter::gl {
namespace {

// A context that reports these errors, one after the other, and this reset status once.
struct FaultyContext {
  std::deque<GLenum> errors;
  GLenum reset = GL_NO_ERROR;

  ErrorSource source() {
    return {[this] {
              if (errors.empty()) return GLenum{GL_NO_ERROR};
              const GLenum error = errors.front();
              errors.pop_front();
              return error;
            },
            [this] { return std::exchange(reset, GL_NO_ERROR); }};
  }
  // The message, "": no exception.
  std::string told() {
    try {
      takeErrors(source());
      return "";
    } catch (const DeviceError& e) {
      return e.what();
    }
  }
};

TEST(DeviceErrors, OtherErrorsAreDiscarded) {
  FaultyContext context{{GL_INVALID_VALUE, GL_INVALID_OPERATION}};
  EXPECT_EQ(context.told(), "");
  EXPECT_TRUE(context.errors.empty());
}

TEST(DeviceErrors, MemoryThatIsUsedUpIsToldOnce) {
  FaultyContext context{{GL_INVALID_VALUE, GL_OUT_OF_MEMORY}};
  EXPECT_NE(context.told().find("out of memory"), std::string::npos);
  EXPECT_EQ(context.told(), "");
}

TEST(DeviceErrors, EveryKindOfResetIsToldOnce) {
  for (const GLenum reset :
       {GL_GUILTY_CONTEXT_RESET, GL_INNOCENT_CONTEXT_RESET, GL_UNKNOWN_CONTEXT_RESET}) {
    FaultyContext context{{}, reset};
    EXPECT_NE(context.told().find("reset the graphics device"), std::string::npos);
    EXPECT_EQ(context.told(), "");
  }
  FaultyContext lost{{GL_CONTEXT_LOST}};
  EXPECT_NE(lost.told().find("reset the graphics device"), std::string::npos);
}

}  // namespace
}  // namespace lamplighter::gl
