// RAII wrappers of OpenGL objects. Move-only; created with direct state access. The context that
// created an object must be current when it is destroyed.
#pragma once

#include <utility>

#include <epoxy/gl.h>

namespace lamplighter::gl {

// Kind::create() makes an object name, Kind::destroy() deletes it.
template <typename Kind>
class Object {
 public:
  Object() = default;  // holds no object
  template <typename... Arguments>
  requires requires(Arguments... arguments) { Kind::create(arguments...); }
  static Object make(Arguments... arguments) {
    Object o;
    o.name_ = Kind::create(arguments...);
    return o;
  }
  Object(Object&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~Object() {
    if (name_ != 0) Kind::destroy(name_);
  }

  GLuint name() const { return name_; }
  explicit operator bool() const { return name_ != 0; }

 private:
  GLuint name_ = 0;
};

// The name from a function of OpenGL that creates several objects.
template <typename Create, typename... Arguments>
GLuint created(Create create, Arguments... arguments) {
  GLuint name = 0;
  create(arguments..., 1, &name);
  return name;
}

struct BufferKind {
  static GLuint create() { return created(glCreateBuffers); }
  static void destroy(GLuint name) { glDeleteBuffers(1, &name); }
};

struct TextureKind {
  static GLuint create(GLenum target) { return created(glCreateTextures, target); }
  static void destroy(GLuint name) { glDeleteTextures(1, &name); }
};

struct FramebufferKind {
  static GLuint create() { return created(glCreateFramebuffers); }
  static void destroy(GLuint name) { glDeleteFramebuffers(1, &name); }
};

struct VertexArrayKind {
  static GLuint create() { return created(glCreateVertexArrays); }
  static void destroy(GLuint name) { glDeleteVertexArrays(1, &name); }
};

struct ShaderKind {
  static GLuint create(GLenum stage) { return glCreateShader(stage); }
  static void destroy(GLuint name) { glDeleteShader(name); }
};

struct ProgramKind {
  static GLuint create() { return glCreateProgram(); }
  static void destroy(GLuint name) { glDeleteProgram(name); }
};

struct QueryKind {
  static GLuint create(GLenum kind) { return created(glCreateQueries, kind); }
  static void destroy(GLuint name) { glDeleteQueries(1, &name); }
};

using Buffer = Object<BufferKind>;
using Texture = Object<TextureKind>;
using Framebuffer = Object<FramebufferKind>;
using VertexArray = Object<VertexArrayKind>;
using Shader = Object<ShaderKind>;
using ProgramObject = Object<ProgramKind>;
using QueryObject = Object<QueryKind>;

// A texture with one mipmap level, for texelFetch or linear filtering.
Texture makeTexture2D(GLenum internalFormat, int width, int height, GLenum filter = GL_NEAREST);

// Binds a texture (all layers of an array) as an image that shaders read or write. `format`: of the
// image variable, as GL_R32UI; access: GL_READ_ONLY, GL_WRITE_ONLY or GL_READ_WRITE.
void bindImage(GLuint unit, const Texture& texture, GLenum format, GLenum access);

}  // namespace lamplighter::gl
