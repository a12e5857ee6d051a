// Driver messages from KHR_debug (core since OpenGL 4.3).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <epoxy/gl.h>

namespace lamplighter::gl {

// Where errors of a context are read.
struct ErrorSource {
  std::function<GLenum()> error;  // as glGetError()
  std::function<GLenum()> reset;  // as glGetGraphicsResetStatus()
};
ErrorSource errorsOfContext();  // of the current one

// Discards the errors that a context has recorded. Throws DeviceError if one of them is that the
// device has no memory left, or if the device was reset, by which the context lost its content.
void takeErrors(const ErrorSource& source = errorsOfContext());

// Receives the messages of the current context during its lifetime. The context must also be
// current when this is destroyed. Errors are kept and, in debug builds, logged. Only a debug
// context reports everything.
class DebugLog {
 public:
  DebugLog();
  ~DebugLog();
  DebugLog(const DebugLog&) = delete;
  DebugLog& operator=(const DebugLog&) = delete;

  // Errors and all messages of high severity, in order of arrival.
  const std::vector<std::string>& errors() const { return errors_; }
  void clear() { errors_.clear(); }

 private:
  static void onMessage(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                        const GLchar* text, const void* user);
  std::vector<std::string> errors_;
};

}  // namespace lamplighter::gl
