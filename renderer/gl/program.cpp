#include "renderer/gl/program.h"

#include "renderer/gl/shader_source.h"

namespace lamplighter::gl {
namespace {

Shader compile(GLenum stage, const ShaderSource& source) {
  Shader shader = Shader::make(stage);
  const char* text = source.text.c_str();
  glShaderSource(shader.name(), 1, &text, nullptr);
  glCompileShader(shader.name());
  GLint ok = GL_FALSE, length = 0;
  glGetShaderiv(shader.name(), GL_COMPILE_STATUS, &ok);
  if (ok == GL_TRUE) return shader;
  glGetShaderiv(shader.name(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<size_t>(length), '\0');
  glGetShaderInfoLog(shader.name(), length, &length, log.data());
  log.resize(static_cast<size_t>(length));
  throw ShaderError("shader " + source.files.front() + " does not compile\n" +
                    nameFiles(log, source.files));
}

}  // namespace

Program::Program(const std::filesystem::path& folder, const ProgramFiles& files)
    : object_(ProgramObject::make()) {
  const Shader vertex = compile(GL_VERTEX_SHADER, loadShader(folder, files.vertex, files.defines));
  glAttachShader(name(), vertex.name());
  Shader fragment;
  if (!files.fragment.empty()) {
    fragment = compile(GL_FRAGMENT_SHADER, loadShader(folder, files.fragment, files.defines));
    glAttachShader(name(), fragment.name());
  }
  glLinkProgram(name());
  glDetachShader(name(), vertex.name());
  if (fragment) glDetachShader(name(), fragment.name());
  GLint ok = GL_FALSE, length = 0;
  glGetProgramiv(name(), GL_LINK_STATUS, &ok);
  if (ok == GL_TRUE) return;
  glGetProgramiv(name(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<size_t>(length), '\0');
  glGetProgramInfoLog(name(), length, &length, log.data());
  log.resize(static_cast<size_t>(length));
  throw ShaderError("program " + files.vertex + " + " + files.fragment + " does not link\n" + log);
}

}  // namespace lamplighter::gl
