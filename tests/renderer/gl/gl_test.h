// The fixture of tests with an OpenGL context.
#pragma once

#include <cstdlib>
#include <memory>

#include <gtest/gtest.h>

#include "renderer/base/error.h"
#include "renderer/gl/headless_context.h"

namespace lamplighter::test {

// Every test has its own context with a debug log, and fails on any error that the driver reports.
// Without OpenGL the test is skipped, unless LAMPLIGHTER_REQUIRE_GL is set.
class GlTest : public ::testing::Test {
 protected:
  void SetUp() override {
    try {
      context_ = std::make_unique<gl::HeadlessContext>(true);
    } catch (const InputError& error) {
      if (std::getenv("LAMPLIGHTER_REQUIRE_GL") != nullptr) FAIL() << error.what();
      GTEST_SKIP() << error.what();
    }
  }
  void TearDown() override {
    if (context_ == nullptr) return;
    for (const std::string& error : context_->debugLog()->errors()) ADD_FAILURE() << error;
  }

  gl::HeadlessContext& context() { return *context_; }

 private:
  std::unique_ptr<gl::HeadlessContext> context_;
};

}  // namespace lamplighter::test
