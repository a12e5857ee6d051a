// The fixture of tests with an OpenGL context.
#pragma once

#include <cstdlib>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "renderer/base/error.h"
#include "renderer/gl/headless_context.h"
#include "renderer/gl/storage_buffer.h"

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

// The elements of a buffer. Waits for the GPU.
template <typename T>
std::vector<T> read(const gl::StorageBuffer<T>& buffer) {
  std::vector<T> values(buffer.size());
  if (values.empty()) return values;
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glGetNamedBufferSubData(buffer.name(), 0, static_cast<GLsizeiptr>(buffer.bytes()), values.data());
  return values;
}

}  // namespace lamplighter::test
