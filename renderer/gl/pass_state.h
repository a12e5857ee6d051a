// The pipeline state of one pass: set by the constructor, and reset to OpenGL's defaults by the
// destructor, so that passes (and the user interface in the same context) do not affect each other.
#pragma once

#include <epoxy/gl.h>

namespace lamplighter::gl {

class PassState {
 public:
  // Draws into the framebuffer from pixel (0, 0), with clip space z from 0 to 1.
  PassState(GLuint framebuffer, int width, int height);
  ~PassState();
  PassState(const PassState&) = delete;
  PassState& operator=(const PassState&) = delete;

  void reversedDepth();  // depth test and write; the greater depth wins
  // Front faces are clockwise in the picture, because row 0 is the top.
  void cullBackFaces(bool on);
  void additive();  // additive blending of colour
  void clipDistances(int count);
  // Stencil bit: mark() sets it to 1 where something is drawn; the others only test it.
  void mark();
  void onlyWhere(bool marked);

 private:
  int clipDistances_ = 0;
};

// Draws shaders/common/full_screen.vert.glsl. OpenGL requires a bound vertex array; an empty one is
// sufficient.
void drawFullScreen(GLuint emptyVertexArray);

}  // namespace lamplighter::gl
