#include "renderer/gl/debug.h"

#include <spdlog/spdlog.h>

#include "renderer/backends/backend.h"

namespace lamplighter::gl {

ErrorSource errorsOfContext() {
  return {[] { return glGetError(); }, [] { return glGetGraphicsResetStatus(); }};
}

void takeErrors(const ErrorSource& source) {
  switch (source.reset()) {
    case GL_NO_ERROR:
      break;
    case GL_GUILTY_CONTEXT_RESET:
      throw DeviceError("OpenGL: the driver has reset the graphics device because a frame failed");
    default:
      throw DeviceError("OpenGL: the driver has reset the graphics device");
  }
  while (const GLenum error = source.error()) {
    if (error == GL_OUT_OF_MEMORY)
      throw DeviceError("OpenGL: the graphics device is out of memory; lower the settings");
    if (error == GL_CONTEXT_LOST)
      throw DeviceError("OpenGL: the driver has reset the graphics device");
  }
}

DebugLog::DebugLog() {
  glEnable(GL_DEBUG_OUTPUT);
  // The callback runs inside the call that causes the message: no locks are needed, and a debugger
  // shows the caller.
  glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
  glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, nullptr, GL_TRUE);
  glDebugMessageCallback(onMessage, this);
}

DebugLog::~DebugLog() {
  glDebugMessageCallback(nullptr, nullptr);
  glDisable(GL_DEBUG_OUTPUT);
}

void DebugLog::onMessage(GLenum, GLenum type, GLuint id, GLenum severity, GLsizei length,
                         const GLchar* text, const void* user) {
  if (type != GL_DEBUG_TYPE_ERROR && type != GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR &&
      severity != GL_DEBUG_SEVERITY_HIGH) {
    return;
  }
  const std::string message = length < 0 ? std::string(text) : std::string(text, length);
  // The listener owns the object; OpenGL passes the pointer as const.
  auto* log = const_cast<DebugLog*>(static_cast<const DebugLog*>(user));
  log->errors_.push_back(message);
#ifdef LAMPLIGHTER_DEBUG
  spdlog::error("OpenGL {}: {}", id, message);
#else
  (void)id;
#endif
}

}  // namespace lamplighter::gl
