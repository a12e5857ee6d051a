// Formats the range of a parameter as text.
#pragma once

#include <string>

#include <spdlog/fmt/fmt.h>

#include "renderer/base/parameters.h"

namespace lamplighter::cli {

inline std::string rangeOf(const ParameterSpec& p) {
  if (!p.choices.empty()) return fmt::format("{}", fmt::join(p.choices, ", "));
  if (std::holds_alternative<bool>(p.defaultValue)) return "true, false";
  if (std::holds_alternative<int>(p.defaultValue)) {
    return fmt::format("{} … {}", static_cast<int64_t>(p.minimum), static_cast<int64_t>(p.maximum));
  }
  return fmt::format("{:g} … {:g}", p.minimum, p.maximum);
}

}  // namespace lamplighter::cli
