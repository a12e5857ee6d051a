// Parameters as members of a struct. A row binds a member and declares the rest of the parameter;
// its default value is the member's initialiser:
//
//   struct ProbeParameters {
//     int probes = 64;
//     bool interpolates = true;
//   };
//   const ParameterTable<ProbeParameters>& probeParameters() {
//     using P = ProbeParameters;
//     static const ParameterTable<P> table{
//         {&P::probes, "probes", "Probes", "", "Number of probes.", {1, 4096, kLogarithmic}},
//         {&P::interpolates, "interpolates", "Interpolate", "Interpolates between probes."}};
//     return table;
//   }
//
// table.specs() goes into MethodInfo, and table.read(settings) returns the struct.
#pragma once

#include <algorithm>
#include <concepts>
#include <functional>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "renderer/base/parameters.h"

namespace lamplighter {

// The range of a number. Its slider is linear unless kLogarithmic is given.
struct ParameterRange {
  double minimum = 0.0, maximum = 0.0;
  bool logarithmic = false;
};
inline constexpr bool kLogarithmic = true;

// A value of a parameter with choices, and its name.
template <typename T>
using ParameterChoice = std::pair<std::string, T>;

// One row, or several tables one after the other. Members may be those of base classes of Options,
// and the table of a base class is part of a table as a row is.
template <typename Options>
class ParameterTable {
  template <typename Owner, typename T>
  using Member = T Owner::*;

 public:
  // A whole number or a real number.
  template <typename Owner, typename T>
  requires(std::same_as<T, int> || std::same_as<T, float>)
      ParameterTable(Member<Owner, T> member, std::string name, std::string label, std::string unit,
                     std::string help, ParameterRange range,
                     ParameterGroup group = ParameterGroup::quality, std::string benefit = {}) {
    add(member, {std::move(name),
                 std::move(label),
                 std::move(unit),
                 std::move(help),
                 Options().*member,
                 range.minimum,
                 range.maximum,
                 range.logarithmic,
                 {},
                 group,
                 std::move(benefit)});
  }

  // A switch.
  template <typename Owner>
  ParameterTable(Member<Owner, bool> member, std::string name, std::string label, std::string help,
                 ParameterGroup group = ParameterGroup::quality) {
    add(member, {std::move(name),
                 std::move(label),
                 {},
                 std::move(help),
                 Options().*member,
                 0.0,
                 0.0,
                 false,
                 {},
                 group});
  }

  // One of some values of any type that can be compared.
  template <typename Owner, typename T>
  ParameterTable(Member<Owner, T> member, std::string name, std::string label, std::string unit,
                 std::string help, std::vector<ParameterChoice<std::type_identity_t<T>>> choices,
                 ParameterGroup group = ParameterGroup::quality) {
    ParameterSpec spec{std::move(name), std::move(label), std::move(unit), std::move(help)};
    spec.group = group;
    for (const auto& [text, value] : choices) {
      spec.choices.push_back(text);
      if (value == Options().*member) spec.defaultValue = text;
    }
    specs_.push_back(std::move(spec));
    setters_.push_back(
        [member, choices = std::move(choices)](Options& options, const ParameterValue& chosen) {
          for (const auto& [text, value] : choices)
            if (text == std::get<std::string>(chosen)) options.*member = value;
        });
  }

  // One of some names.
  template <typename Owner>
  ParameterTable(Member<Owner, std::string> member, std::string name, std::string label,
                 std::string help, std::vector<std::string> choices) {
    ParameterSpec spec{std::move(name), std::move(label), {}, std::move(help), Options().*member};
    spec.choices = std::move(choices);
    add(member, std::move(spec));
  }

  ParameterTable(std::initializer_list<ParameterTable> parts) {
    for (const ParameterTable& part : parts) append(part);
  }
  void append(const ParameterTable& part) {
    specs_.insert(specs_.end(), part.specs_.begin(), part.specs_.end());
    setters_.insert(setters_.end(), part.setters_.begin(), part.setters_.end());
  }

  template <typename Base>
  requires(std::derived_from<Options, Base> && !std::same_as<Options, Base>)
      ParameterTable(const ParameterTable<Base>& table)
      : specs_(table.specs_), setters_(table.setters_.begin(), table.setters_.end()) {}

  const std::vector<ParameterSpec>& specs() const { return specs_; }
  // Throws std::out_of_range if there is no parameter of that name.
  const ParameterSpec& operator[](std::string_view name) const { return specs_[indexOf(name)]; }
  // The table of a single parameter of this one.
  ParameterTable only(std::string_view name) const {
    ParameterTable row({});
    row.specs_.push_back((*this)[name]);
    row.setters_.push_back(setters_[indexOf(name)]);
    return row;
  }

  // This table with all parameters in another group.
  ParameterTable inGroup(ParameterGroup group) const {
    ParameterTable moved = *this;
    for (ParameterSpec& spec : moved.specs_) spec.group = group;
    return moved;
  }

  // Members whose parameter is not set have their default value.
  Options read(const Settings& settings) const {
    Options options;
    for (size_t i = 0; i < specs_.size(); ++i) {
      const auto set = settings.values().find(specs_[i].name);
      if (set != settings.values().end()) setters_[i](options, set->second);
    }
    return options;
  }

 private:
  template <typename>
  friend class ParameterTable;

  template <typename Owner, typename T>
  void add(Member<Owner, T> member, ParameterSpec spec) {
    specs_.push_back(std::move(spec));
    setters_.push_back([member](Options& options, const ParameterValue& value) {
      options.*member = std::get<T>(value);
    });
  }

  size_t indexOf(std::string_view name) const {
    const ParameterSpec* spec = findParameter(specs_, name);
    if (!spec) throw std::out_of_range("there is no parameter " + std::string(name));
    return static_cast<size_t>(spec - specs_.data());
  }

  std::vector<ParameterSpec> specs_;
  std::vector<std::function<void(Options&, const ParameterValue&)>> setters_;
};

}  // namespace lamplighter
