#include "renderer/gl/picture_passes.h"

#include "renderer/gl/pass_state.h"
#include "shaders/shared/bindings.h"

namespace lamplighter::gl {

PicturePasses::PicturePasses(const std::filesystem::path& shaders)
    : emptyVertexArray_(VertexArray::make()), framebuffer_(Framebuffer::make()) {
  reload(shaders);
}

void PicturePasses::reload(const std::filesystem::path& shaders) {
  const auto program = [&](const char* operation) {
    return Program(
        shaders,
        {"common/full_screen.vert.glsl", "passes/combine_pictures.frag.glsl", {operation}});
  };
  Program multiply = program("MULTIPLY"), subtract = program("SUBTRACT"),
          average = program("AVERAGE");
  multiply_ = std::move(multiply);
  subtract_ = std::move(subtract);
  average_ = std::move(average);
}

void PicturePasses::draw(const Program& program, GLuint first, GLuint second, GLuint result,
                         glm::ivec2 size) {
  glNamedFramebufferTexture(framebuffer_.name(), GL_COLOR_ATTACHMENT0, result, 0);
  const PassState state(framebuffer_.name(), size.x, size.y);
  glBindTextureUnit(shared::kPicture, first);
  glBindTextureUnit(shared::kOtherPicture, second);
  program.use();
  drawFullScreen(emptyVertexArray_.name());
}

void PicturePasses::multiply(GLuint picture, GLuint gains, GLuint result, glm::ivec2 size) {
  draw(multiply_, picture, gains, result, size);
}

void PicturePasses::subtract(GLuint picture, GLuint taken, GLuint result, glm::ivec2 size) {
  draw(subtract_, picture, taken, result, size);
}

void PicturePasses::average(GLuint picture, int block, GLuint result, glm::ivec2 size) {
  average_.set(0, block);
  draw(average_, picture, 0, result, size);
}

}  // namespace lamplighter::gl
