#include "editor/notices/failure_text.h"

#include <new>
#include <system_error>

#include "renderer/backends/backend.h"
#include "renderer/base/error.h"
#include "renderer/base/text.h"

namespace lamplighter {

namespace {

template <typename T>
bool is(const std::exception& e) {
  return dynamic_cast<const T*>(&e) != nullptr;
}

}  // namespace

std::string failureText(const std::exception& e) {
  if (is<std::bad_alloc>(e))
    return "out of memory; the scene, the picture or the settings are too large for this machine";
  const bool isOfTheSystem = is<InputError>(e) || is<DeviceError>(e) || is<std::system_error>(e);
  return oneLine(e.what()) + (isOfTheSystem ? "" : "; this is a bug of the program");
}

}  // namespace lamplighter
