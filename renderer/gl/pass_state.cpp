#include "renderer/gl/pass_state.h"

namespace lamplighter::gl {

PassState::PassState(GLuint framebuffer, int width, int height) {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(0, 0, width, height);
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_STENCIL_TEST);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glDisable(GL_DITHER);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

PassState::~PassState() {
  for (int i = 0; i < clipDistances_; ++i) glDisable(GL_CLIP_DISTANCE0 + static_cast<GLenum>(i));
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_STENCIL_TEST);
  glStencilMask(~0u);
  glFrontFace(GL_CCW);
  glDepthFunc(GL_LESS);
  glClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  glUseProgram(0);
  glBindVertexArray(0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void PassState::reversedDepth() {
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GREATER);
  glDepthMask(GL_TRUE);
}

void PassState::cullBackFaces(bool on) {
  if (!on) return glDisable(GL_CULL_FACE);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glFrontFace(GL_CW);
}

void PassState::additive() {
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE);
}

void PassState::clipDistances(int count) {
  clipDistances_ = count;
  for (int i = 0; i < count; ++i) glEnable(GL_CLIP_DISTANCE0 + static_cast<GLenum>(i));
}

void PassState::mark() {
  glEnable(GL_STENCIL_TEST);
  glStencilMask(~0u);
  glStencilFunc(GL_ALWAYS, 1, ~0u);
  glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
}

void PassState::onlyWhere(bool marked) {
  glEnable(GL_STENCIL_TEST);
  glStencilMask(0);
  glStencilFunc(GL_EQUAL, marked ? 1 : 0, ~0u);
  glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
}

void drawFullScreen(GLuint emptyVertexArray) {
  glBindVertexArray(emptyVertexArray);
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace lamplighter::gl
