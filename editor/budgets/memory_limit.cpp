#include "editor/budgets/memory_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace lamplighter {
namespace {

bool isMemoryLimit(const ParameterSpec& spec) {
  return spec.group == ParameterGroup::budgets && spec.unit == "MiB" &&
         std::holds_alternative<int>(spec.defaultValue);
}

std::vector<const ParameterSpec*> limitsOf(const MethodInfo& method) {
  std::vector<const ParameterSpec*> limits;
  for (const ParameterSpec& spec : method.parameters)
    if (isMemoryLimit(spec)) limits.push_back(&spec);
  return limits;
}

double byDefault(const ParameterSpec& spec) {
  return static_cast<double>(std::get<int>(spec.defaultValue));
}

// A limit of 0 leaves out what it limits, which is not what less memory is meant to do.
double leastOf(const ParameterSpec& spec) { return std::max(spec.minimum, 1.0); }

template <typename Value>
double sumOf(const std::vector<const ParameterSpec*>& limits, const Value& value) {
  return std::accumulate(limits.begin(), limits.end(), 0.0,
                         [&](double sum, const ParameterSpec* spec) { return sum + value(*spec); });
}

}  // namespace

int memoryLimit(const MethodInfo& method, const Settings& settings) {
  return static_cast<int>(sumOf(limitsOf(method), [&](const ParameterSpec& spec) {
    return static_cast<double>(settings.integer(spec));
  }));
}

MemoryRange memoryRange(const MethodInfo& method) {
  const auto limits = limitsOf(method);
  if (limits.empty()) return {};
  double least = 0.0, most = std::numeric_limits<double>::infinity();
  for (const ParameterSpec* spec : limits) {
    least = std::max(least, leastOf(*spec) / byDefault(*spec));
    most = std::min(most, spec->maximum / byDefault(*spec));
  }
  const double all = sumOf(limits, byDefault);
  return {static_cast<int>(std::ceil(least * all)), static_cast<int>(most * all)};
}

Settings withMemoryLimit(const MethodInfo& method, Settings settings, int total) {
  const auto limits = limitsOf(method);
  const double scale = total / std::max(sumOf(limits, byDefault), 1.0);
  for (const ParameterSpec* spec : limits) {
    const int value = static_cast<int>(
        std::clamp(std::round(scale * byDefault(*spec)), leastOf(*spec), spec->maximum));
    if (value == std::get<int>(spec->defaultValue))
      settings.reset(spec->name);
    else
      settings.set(spec->name, value);
  }
  return settings;
}

uint64_t memoryUsed(const MethodInfo& method, const GiStats& now) {
  double used = 0.0;
  for (const auto& [spec, value] : now.declared) {
    const ParameterSpec* limit = findParameter(method.parameters, spec->budget);
    if (limit != nullptr && isMemoryLimit(*limit) && spec->unit == "bytes" && spec->isHeld &&
        spec->kind == StatisticKind::state)
      used += value;
  }
  return static_cast<uint64_t>(used);
}

}  // namespace lamplighter
