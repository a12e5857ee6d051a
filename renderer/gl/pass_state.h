// The pipeline state of one pass, set on entry and put back to OpenGL's defaults on exit, so that
// passes (and the user interface, which draws in the same context) do not depend on each other.
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

  void reversedDepth();  // depth test and write, the greater one stays
  // Front faces are clockwise in the pictures' pixels, since row 0 is the top there.
  void cullBackFaces(bool on);
  void additive();  // colour is added to what is there
  void clipDistances(int count);
  // The stencil buffer's bits: set to 1 by what is drawn, or asked and left as they are.
  void mark();
  void onlyWhere(bool marked);

 private:
  int clipDistances_ = 0;
};

// Draws shaders/common/full_screen.vert.glsl; some vertex array must be bound, an empty one will
// do.
void drawFullScreen(GLuint emptyVertexArray);

}  // namespace lamplighter::gl
