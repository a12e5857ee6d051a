#include "renderer/gl/program.h"

#include "renderer/base/error.h"
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

Program::Program(const std::filesystem::path& folder, const std::vector<Stage>& stages,
                 const std::vector<std::string>& defines)
    : object_(ProgramObject::make()) {
  std::vector<Shader> shaders;
  std::string names;
  for (const Stage& stage : stages) {
    if (stage.file.empty()) continue;
    shaders.push_back(compile(stage.kind, loadShader(folder, stage.file, defines)));
    glAttachShader(name(), shaders.back().name());
    names += (names.empty() ? "" : " + ") + stage.file;
  }
  glLinkProgram(name());
  for (const Shader& shader : shaders) glDetachShader(name(), shader.name());
  GLint ok = GL_FALSE, length = 0;
  glGetProgramiv(name(), GL_LINK_STATUS, &ok);
  if (ok == GL_TRUE) return;
  glGetProgramiv(name(), GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<size_t>(length), '\0');
  glGetProgramInfoLog(name(), length, &length, log.data());
  log.resize(static_cast<size_t>(length));
  throw ShaderError("program " + names + " does not link\n" + log);
}

Program::Program(const std::filesystem::path& folder, const ProgramFiles& files)
    : Program(folder, {{GL_VERTEX_SHADER, files.vertex}, {GL_FRAGMENT_SHADER, files.fragment}},
              files.defines) {}

ComputeProgram::ComputeProgram(const std::filesystem::path& folder, const std::string& file,
                               const std::vector<std::string>& defines)
    : Program(folder, {{GL_COMPUTE_SHADER, file}}, defines) {
  glGetProgramiv(name(), GL_COMPUTE_WORK_GROUP_SIZE, groupSize_);
}

void ComputeProgram::dispatch(const glm::uvec3& invocations, GLbitfield readers) const {
  glm::uvec3 groups(0);
  for (int i = 0; i < 3; ++i) {
    const auto size = static_cast<uint32_t>(groupSize_[i]);
    groups[i] = invocations[i] / size + (invocations[i] % size != 0 ? 1 : 0);
    GLint most = 0;
    glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, static_cast<GLuint>(i), &most);
    if (groups[i] > static_cast<uint32_t>(most)) {
      throw InputError("OpenGL",
                       "a dispatch of " + std::to_string(groups[i]) +
                           " work groups exceeds the limit of this driver (" +
                           std::to_string(most) + ")",
                       "use --backend cpu");
    }
  }
  use();
  glDispatchCompute(groups.x, groups.y, groups.z);  // nothing happens if one of them is 0
  glMemoryBarrier(readers);
  glUseProgram(0);
}

}  // namespace lamplighter::gl
