// A linked program made from shader files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/base/math.h"
#include "renderer/gl/objects.h"

namespace lamplighter::gl {

struct ProgramFiles {
  std::string vertex;    // relative to the shader folder
  std::string fragment;  // "": none (depth only)
  std::vector<std::string> defines = {};
};

class Program {
 public:
  Program() = default;
  // Throws ShaderError.
  Program(const std::filesystem::path& folder, const ProgramFiles& files);

  GLuint name() const { return object_.name(); }
  explicit operator bool() const { return static_cast<bool>(object_); }
  void use() const { glUseProgram(name()); }

  // Sets a uniform by its layout(location = …).
  void set(GLint location, int v) const { glProgramUniform1i(name(), location, v); }
  void set(GLint location, float v) const { glProgramUniform1f(name(), location, v); }
  void set(GLint location, const vec2& v) const { glProgramUniform2fv(name(), location, 1, &v.x); }
  void set(GLint location, const vec3& v) const { glProgramUniform3fv(name(), location, 1, &v.x); }
  void set(GLint location, const vec4& v) const { glProgramUniform4fv(name(), location, 1, &v.x); }
  void set(GLint location, const mat4& v) const {
    glProgramUniformMatrix4fv(name(), location, 1, GL_FALSE, &v[0].x);
  }

 private:
  ProgramObject object_;
};

}  // namespace lamplighter::gl
