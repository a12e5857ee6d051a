// Parameters as data: each is declared once; panel, command line, recordings and docs use that
// declaration.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace lamplighter {

using ParameterValue = std::variant<bool, int, float, std::string>;

// Panels show the parameters of a group together, in this order.
enum class ParameterGroup { lightSamples, budgets, quality, technique, picture };
inline constexpr ParameterGroup kParameterGroups[] = {
    ParameterGroup::lightSamples, ParameterGroup::budgets, ParameterGroup::quality,
    ParameterGroup::technique, ParameterGroup::picture};
const char* labelOf(ParameterGroup group);  // "Light samples"

struct ParameterSpec {
  std::string name;   // as in --set name=value
  std::string label;  // as in the panel
  std::string unit;   // "" for counts and ratios
  std::string help;   // one sentence
  ParameterValue defaultValue;
  double minimum = 0.0, maximum = 0.0;  // int and float
  bool logarithmic = false;             // the slider's scale
  std::vector<std::string> choices;     // for strings: the allowed ones
  ParameterGroup group = ParameterGroup::quality;
  std::string benefit;  // of a budget: what a larger value gives, one sentence
};

// nullptr if there is none of that name.
const ParameterSpec* findParameter(const std::vector<ParameterSpec>& specs, std::string_view name);

// Values of a set of declared parameters. A parameter that is not set has its default value.
class Settings {
 public:
  // Throws InputError if the text is not a value in the parameter's range.
  static ParameterValue parse(const ParameterSpec& spec, std::string_view text);
  static std::string format(const ParameterValue& value);

  void set(const std::string& name, ParameterValue value) { values_[name] = std::move(value); }
  void reset(const std::string& name) { values_.erase(name); }
  bool has(const std::string& name) const { return values_.contains(name); }
  const std::map<std::string, ParameterValue>& values() const { return values_; }

  template <typename T>
  T get(const ParameterSpec& spec) const {
    const auto it = values_.find(spec.name);
    return std::get<T>(it == values_.end() ? spec.defaultValue : it->second);
  }
  int integer(const ParameterSpec& spec) const { return get<int>(spec); }
  float real(const ParameterSpec& spec) const { return get<float>(spec); }
  bool boolean(const ParameterSpec& spec) const { return get<bool>(spec); }
  std::string choice(const ParameterSpec& spec) const { return get<std::string>(spec); }

  bool operator==(const Settings&) const = default;

 private:
  std::map<std::string, ParameterValue> values_;
};

}  // namespace lamplighter
