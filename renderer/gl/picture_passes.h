// Passes over whole pictures, so that these need not leave the GPU.
#pragma once

#include <filesystem>

#include "renderer/gl/program.h"
#include "renderer/gl/waits.h"

namespace lamplighter::gl {

// All pictures are textures with at least the channels RGB; the result has RGBA with A = 1.
class PicturePasses {
 public:
  explicit PicturePasses(const std::filesystem::path& shaders);
  void reload(const std::filesystem::path& shaders);

  // Each pixel times that of `gains`. All have the same size.
  void multiply(GLuint picture, GLuint gains, GLuint result, glm::ivec2 size);
  // Each pixel minus that of `taken`.
  void subtract(GLuint picture, GLuint taken, GLuint result, glm::ivec2 size);
  // The means of blocks of block × block pixels; `size`: of the result.
  void average(GLuint picture, int block, GLuint result, glm::ivec2 size);

  Waits& waits() { return waits_; }
  const Waits& waits() const { return waits_; }

 private:
  void draw(const Program& program, GLuint first, GLuint second, GLuint result, glm::ivec2 size);

  Program multiply_, subtract_, average_;
  VertexArray emptyVertexArray_;
  Framebuffer framebuffer_;
  Waits waits_;
};

}  // namespace lamplighter::gl
