#include "renderer/base/statistics.h"

#include <cmath>

#include <spdlog/fmt/fmt.h>

namespace lamplighter {
namespace {

std::string grouped(double value) {
  std::string text = fmt::format("{:.0f}", value);
  const size_t sign = value < 0.0 ? 1 : 0;
  for (size_t end = text.size(); end > sign + 3; end -= 3) text.insert(end - 3, 1, ',');
  return text;
}

void replace(std::string& text, std::string_view what, std::string_view with) {
  if (const size_t at = text.find(what); at != std::string::npos)
    text.replace(at, what.size(), with);
}

bool continues(const std::string& pattern) { return pattern[0] == ',' || pattern[0] == ' '; }

}  // namespace

std::string valueText(const StatisticSpec& spec, double value) {
  if (spec.unit == "bytes") return fmt::format("{:.3g} MiB", value / (1 << 20));
  if (spec.unit == "share")
    return fmt::format("{:.0f}%", std::floor(100.0f * static_cast<float>(value)));
  if (spec.unit == "%") return fmt::format("{:.0f}%", std::floor(value));
  if (spec.unit == "m") return fmt::format("{:.2g} m", value);
  return spec.isWhole ? grouped(value) : fmt::format("{:.3g}", value);
}

std::string filled(const std::string& pattern, const StatisticSpec& spec, double value) {
  std::string text = pattern;
  replace(text, "(s)", value == 1.0 ? "" : "s");
  replace(text, "(es)", value == 1.0 ? "" : "es");
  replace(text, "{}", valueText(spec, value));
  return text;
}

std::vector<StatusText> statusTexts(const std::vector<Statistic>& statistics) {
  std::vector<StatusText> texts;
  bool isShown = false;  // the text that the next one may continue
  for (const auto& [spec, value] : statistics) {
    if (spec->status.empty()) continue;
    const bool isPart = continues(spec->status);
    if (isPart && !isShown) continue;
    const bool isSeen = value >= spec->shownFrom && value < spec->shownBelow;
    if (!isPart) isShown = isSeen;
    if (!isSeen) continue;
    const std::string text = filled(spec->status, *spec, value);
    if (isPart) {
      texts.back().text += text;
      texts.back().meaning += " " + spec->meaning;
    } else {
      texts.push_back(
          {spec->name, text, spec->meaning, spec->kind == StatisticKind::pending, value == 0.0});
    }
  }
  return texts;
}

void accumulate(std::vector<Statistic>& total, const std::vector<Statistic>& frame) {
  std::vector<Statistic> sum = frame;
  for (size_t i = 0; i < total.size() && i < sum.size(); ++i)
    if (sum[i].spec->kind == StatisticKind::work) sum[i].value += total[i].value;
  total = std::move(sum);
}

}  // namespace lamplighter
