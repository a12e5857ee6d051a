#include "editor/explain/quantity.h"

#include <cmath>

#include <spdlog/fmt/fmt.h>

namespace lamplighter {

std::string threeDigits(float value) {
  if (!std::isfinite(value)) return "?";
  if (std::abs(value) < 999.5f) return fmt::format("{:.3g}", value);
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 2);
  return fmt::format("{:.0f}", std::round(static_cast<double>(value) / unit) * unit);
}

std::string luxText(float irradiance) { return threeDigits(irradiance) + " lx"; }
std::string nitsText(float luminance) { return threeDigits(luminance) + " nt"; }
std::string metresText(float metres) {
  const bool isTiny = metres > 0.0f && metres < 0.0995f;
  return isTiny ? fmt::format("{:.3g} m", metres) : fmt::format("{:.3f} m", metres);
}

std::string offsetText(const vec3& d) {
  return fmt::format("dx {:+.3f}  dy {:+.3f}  dz {:+.3f} m", d.x, d.y, d.z);
}

std::string percentText(float share) {
  const float percent = 100.0f * share;
  if (percent == 0.0f) return "0%";
  if (percent < 0.05f) return "<0.1%";
  return percent < 0.95f ? fmt::format("{:.1g}%", percent) : fmt::format("{:.0f}%", percent);
}

}  // namespace lamplighter
