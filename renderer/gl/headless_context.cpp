#include "renderer/gl/headless_context.h"

#include <string_view>
#include <vector>

#include <epoxy/egl.h>

#include "renderer/base/error.h"

namespace lamplighter::gl {
namespace {

constexpr char kRemedy[] =
    "install an OpenGL 4.5 driver (Debian: libegl1 libgl1-mesa-dri) or use --backend cpu";

bool has(const char* extensions, std::string_view name) {
  std::string_view rest = extensions == nullptr ? "" : extensions;
  while (!rest.empty()) {
    const size_t end = rest.find(' ');
    if (rest.substr(0, end) == name) return true;
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  }
  return false;
}

// In the order of trial: GPUs by name, the choice of Mesa's surfaceless platform, the rest
// (software devices).
std::vector<EGLDisplay> candidates() {
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  std::vector<EGLDisplay> first, last;
  if (has(client, "EGL_EXT_device_enumeration") && has(client, "EGL_EXT_device_query") &&
      has(client, "EGL_EXT_platform_device")) {
    EGLint count = 0;
    eglQueryDevicesEXT(0, nullptr, &count);
    std::vector<EGLDeviceEXT> devices(static_cast<size_t>(count));
    eglQueryDevicesEXT(count, devices.data(), &count);
    devices.resize(static_cast<size_t>(count));
    for (EGLDeviceEXT device : devices) {
      const bool software =
          has(eglQueryDeviceStringEXT(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
      EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
      if (display != EGL_NO_DISPLAY) (software ? last : first).push_back(display);
    }
  }
  if (has(client, "EGL_MESA_platform_surfaceless")) {
    EGLDisplay display =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display != EGL_NO_DISPLAY) first.push_back(display);
  }
  first.insert(first.end(), last.begin(), last.end());
  return first;
}

// EGL_NO_CONTEXT if this display has no such context.
EGLContext makeContext(EGLDisplay display, bool debug) {
  if (eglInitialize(display, nullptr, nullptr) != EGL_TRUE) return EGL_NO_CONTEXT;
  const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
  if (!has(extensions, "EGL_KHR_surfaceless_context")) return EGL_NO_CONTEXT;
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return EGL_NO_CONTEXT;
  EGLConfig config = EGL_NO_CONFIG_KHR;
  if (!has(extensions, "EGL_KHR_no_config_context")) {
    const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
    EGLint count = 0;
    if (eglChooseConfig(display, wanted, &config, 1, &count) != EGL_TRUE || count == 0) {
      return EGL_NO_CONTEXT;
    }
  }
  const std::vector<EGLint> attributes = {EGL_CONTEXT_MAJOR_VERSION,
                                          4,
                                          EGL_CONTEXT_MINOR_VERSION,
                                          5,
                                          EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                          EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                          EGL_CONTEXT_OPENGL_DEBUG,
                                          debug ? EGL_TRUE : EGL_FALSE,
                                          EGL_NONE};
  // Tells of resets of the device (takeErrors()), where the driver can.
  std::vector<EGLint> robust = attributes;
  robust.insert(robust.end() - 1,
                {EGL_CONTEXT_OPENGL_RESET_NOTIFICATION_STRATEGY, EGL_LOSE_CONTEXT_ON_RESET});
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, robust.data());
  return context != EGL_NO_CONTEXT
             ? context
             : eglCreateContext(display, config, EGL_NO_CONTEXT, attributes.data());
}

}  // namespace

HeadlessContext::HeadlessContext(bool debug) {
  const std::vector<EGLDisplay> displays = candidates();
  for (EGLDisplay display : displays) {
    EGLContext context = makeContext(display, debug);
    if (context == EGL_NO_CONTEXT) continue;
    if (eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context) != EGL_TRUE) {
      eglDestroyContext(display, context);
      continue;
    }
    display_ = display;
    context_ = context;
    break;
  }
  if (context_ == nullptr) {
    throw InputError("OpenGL",
                     displays.empty() ? "EGL cannot render without a window on this machine"
                                      : "no EGL device supports an OpenGL 4.5 core context",
                     kRemedy);
  }
  renderer_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  if (debug) debugLog_ = std::make_unique<DebugLog>();
}

HeadlessContext::~HeadlessContext() {
  if (debugLog_ != nullptr) {
    makeCurrent();  // so that debugLog_ can stop listening
    debugLog_.reset();
  }
  if (eglGetCurrentContext() == context_) {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  eglDestroyContext(display_, context_);
  // No eglTerminate: the display is shared by the whole process, and others may use it.
}

void HeadlessContext::makeCurrent() {
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
    throw std::runtime_error("EGL refuses to make its context current");
  }
}

}  // namespace lamplighter::gl
