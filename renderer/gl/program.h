// Linked programs made from shader files.
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
  void set(GLint location, uint32_t v) const { glProgramUniform1ui(name(), location, v); }
  void set(GLint location, float v) const { glProgramUniform1f(name(), location, v); }
  void set(GLint location, const vec2& v) const { glProgramUniform2fv(name(), location, 1, &v.x); }
  void set(GLint location, const vec3& v) const { glProgramUniform3fv(name(), location, 1, &v.x); }
  void set(GLint location, const vec4& v) const { glProgramUniform4fv(name(), location, 1, &v.x); }
  void set(GLint location, const mat4& v) const {
    glProgramUniformMatrix4fv(name(), location, 1, GL_FALSE, &v[0].x);
  }

 protected:
  struct Stage {
    GLenum kind;
    std::string file;
  };
  Program(const std::filesystem::path& folder, const std::vector<Stage>& stages,
          const std::vector<std::string>& defines);

 private:
  ProgramObject object_;
};

// A compute shader.
class ComputeProgram : public Program {
 public:
  ComputeProgram() = default;
  // Throws ShaderError.
  ComputeProgram(const std::filesystem::path& folder, const std::string& file,
                 const std::vector<std::string>& defines = {});

  // Runs the shader with at least this many invocations, in whole work groups: the shader compares
  // gl_GlobalInvocationID with the size that it needs. `readers`: how later commands read what the
  // shader writes, as bits of glMemoryBarrier(). Throws InputError if there are more work groups
  // than OpenGL allows.
  void dispatch(const glm::uvec3& invocations, GLbitfield readers) const;
  void dispatch(uint32_t invocations, GLbitfield readers) const {
    dispatch({invocations, 1, 1}, readers);
  }

 private:
  GLint groupSize_[3] = {1, 1, 1};
};

}  // namespace lamplighter::gl
