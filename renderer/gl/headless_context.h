// An OpenGL 4.5 core context without any window or display server, through EGL.
#pragma once

#include <memory>
#include <string>

#include "renderer/gl/debug.h"

namespace lamplighter::gl {

// Debug builds ask for a debug context.
#ifdef LAMPLIGHTER_DEBUG
inline constexpr bool kDebugContextByDefault = true;
#else
inline constexpr bool kDebugContextByDefault = false;
#endif

// Prefers a GPU to a software driver. The context is current on the thread that made it until it is
// destroyed.
class HeadlessContext {
 public:
  // Throws InputError, which names the packages to install, if no such context is available.
  explicit HeadlessContext(bool debug = kDebugContextByDefault);
  ~HeadlessContext();
  HeadlessContext(const HeadlessContext&) = delete;
  HeadlessContext& operator=(const HeadlessContext&) = delete;

  void makeCurrent();
  const std::string& renderer() const { return renderer_; }  // GL_RENDERER
  DebugLog* debugLog() { return debugLog_.get(); }           // null unless debug

 private:
  void* display_ = nullptr;  // EGLDisplay
  void* context_ = nullptr;  // EGLContext
  std::string renderer_;
  std::unique_ptr<DebugLog> debugLog_;
};

}  // namespace lamplighter::gl
