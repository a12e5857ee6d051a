// What the driver says through KHR_debug (core since OpenGL 4.3).
#pragma once

#include <string>
#include <vector>

#include <epoxy/gl.h>

namespace lamplighter::gl {

// Listens to the current context for as long as it lives; that context must be current when it is
// destroyed too. Errors are kept and, in debug builds, logged. Needs a debug context to hear all.
class DebugLog {
 public:
  DebugLog();
  ~DebugLog();
  DebugLog(const DebugLog&) = delete;
  DebugLog& operator=(const DebugLog&) = delete;

  // Errors and whatever is of high severity, in the order they came.
  const std::vector<std::string>& errors() const { return errors_; }
  void clear() { errors_.clear(); }

 private:
  static void onMessage(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                        const GLchar* text, const void* user);
  std::vector<std::string> errors_;
};

}  // namespace lamplighter::gl
