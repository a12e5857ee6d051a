#include "ui/platform/ui_scale.h"

#include <cstdlib>

#include "renderer/base/error.h"

namespace lamplighter {
namespace {

constexpr const char* kVariable = "LAMPLIGHTER_UI_SCALE";

}  // namespace

float parseUiScale(const std::string& text) {
  char* end = nullptr;
  const float scale = std::strtof(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(scale >= kLeastUiScale && scale <= kMostUiScale))
    throw InputError(kVariable, "'" + text + "' is not a number from 0.5 to 4",
                     "set it to 2 for a user interface twice as large, or unset it");
  return scale;
}

std::optional<float> askedUiScale() {
  const char* text = std::getenv(kVariable);
  if (text == nullptr) return std::nullopt;
  return parseUiScale(text);
}

}  // namespace lamplighter
