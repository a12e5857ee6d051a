#include "editor/document/sky_text.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <vector>

#include "renderer/base/error.h"

namespace lamplighter {

namespace {

constexpr float kMostRadiance = 1e9f;

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == at)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

std::optional<float> number(const std::string& text) {
  float v = 0.0f;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return v;
}

// Three numbers, or one for all three.
vec3 colour(const std::string& text) {
  const std::vector<std::string> parts = split(text, ',');
  vec3 out;
  for (size_t c = 0; c < 3; ++c) {
    const auto v = number(parts[parts.size() == 1 ? 0 : std::min(c, parts.size() - 1)]);
    if ((parts.size() != 1 && parts.size() != 3) || !v || !(*v >= 0.0f && *v <= kMostRadiance)) {
      throw InputError("sky", "'" + text + "' is not a radiance",
                       "give R,G,B in W/(m2 sr), each from 0 to 1e9");
    }
    out[static_cast<int>(c)] = *v;
  }
  return out;
}

bool looksLikeNumbers(const std::string& text) {
  return number(split(text, ',').front()).has_value();
}

}  // namespace

std::shared_ptr<const SkyImage> findSkyImage(const std::filesystem::path& file,
                                             const std::filesystem::path& folder) {
  std::error_code ignored;
  const bool isBeside = !folder.empty() && file.is_relative() &&
                        !std::filesystem::exists(file, ignored) &&
                        std::filesystem::exists(folder / file, ignored);
  return readSkyImage(isBeside ? folder / file : file);
}

Sky parseSky(const std::string& text, const std::filesystem::path& folder) {
  constexpr const char* kGradient = "gradient:";
  if (text.empty() || text == "none") return Sky();
  if (text.starts_with(kGradient)) {
    const std::vector<std::string> parts = split(text.substr(std::string(kGradient).size()), '/');
    if (parts.size() != 3) {
      throw InputError("sky", "'" + text + "' is not a gradient",
                       "give gradient:R,G,B/R,G,B/R,G,B for zenith, horizon and ground");
    }
    return Sky::gradient(colour(parts[0]), colour(parts[1]), colour(parts[2]));
  }
  std::error_code ignored;
  if (looksLikeNumbers(text) && !std::filesystem::exists(text, ignored)) return colour(text);
  return Sky::picture(findSkyImage(text, folder));
}

}  // namespace lamplighter
