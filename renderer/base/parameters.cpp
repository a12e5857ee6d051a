#include "renderer/base/parameters.h"

#include <algorithm>
#include <charconv>

#include <spdlog/fmt/fmt.h>

#include "renderer/base/error.h"

namespace lamplighter {

namespace {

// Makes any text from a file or caller fit into a one-line message.
std::string shown(std::string_view text) {
  constexpr size_t kLongest = 60;
  std::string out(text.substr(0, kLongest));
  for (char& c : out)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return text.size() > kLongest ? out + "..." : out;
}

template <typename T>
T parseNumber(const ParameterSpec& spec, std::string_view text, const char* kind) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  // In the type of the value: 0.01 is within a range from 0.01, although the nearest float is less.
  const bool inRange =
      value >= static_cast<T>(spec.minimum) && value <= static_cast<T>(spec.maximum);
  if (error != std::errc() || end != text.data() + text.size() || !inRange) {
    throw InputError(spec.name,
                     fmt::format("'{}' is not a {} from {:g} to {:g}", shown(text), kind,
                                 spec.minimum, spec.maximum),
                     "give one in that range");
  }
  return value;
}

}  // namespace

const char* labelOf(ParameterGroup group) {
  switch (group) {
    case ParameterGroup::lightSamples:
      return "Light samples";
    case ParameterGroup::budgets:
      return "Budgets";
    case ParameterGroup::quality:
      return "Quality";
    case ParameterGroup::technique:
      return "Technique";
    case ParameterGroup::picture:
      break;
  }
  return "Picture";
}

const ParameterSpec* findParameter(const std::vector<ParameterSpec>& specs, std::string_view name) {
  const auto it = std::find_if(specs.begin(), specs.end(),
                               [&](const ParameterSpec& spec) { return spec.name == name; });
  return it == specs.end() ? nullptr : &*it;
}

ParameterValue Settings::parse(const ParameterSpec& spec, std::string_view text) {
  if (std::holds_alternative<int>(spec.defaultValue))
    return parseNumber<int>(spec, text, "whole number");
  if (std::holds_alternative<float>(spec.defaultValue))
    return parseNumber<float>(spec, text, "number");
  if (std::holds_alternative<bool>(spec.defaultValue)) {
    if (text == "true" || text == "on" || text == "1") return true;
    if (text == "false" || text == "off" || text == "0") return false;
    throw InputError(spec.name, fmt::format("'{}' is neither true nor false", shown(text)),
                     "give true or false");
  }
  if (std::find(spec.choices.begin(), spec.choices.end(), text) == spec.choices.end()) {
    throw InputError(spec.name, fmt::format("'{}' is not one of its choices", shown(text)),
                     fmt::format("give one of: {}", fmt::join(spec.choices, ", ")));
  }
  return std::string(text);
}

std::string Settings::format(const ParameterValue& value) {
  struct Visitor {
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(int v) const { return fmt::format("{}", v); }
    std::string operator()(float v) const {
      return fmt::format("{}", v);
    }  // shortest text that gives the same value
    std::string operator()(const std::string& v) const { return v; }
  };
  return std::visit(Visitor(), value);
}

}  // namespace lamplighter
