// IESNA LM-63: keyword lines, TILT=, then numbers with arbitrary line breaks.
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>

#include <spdlog/fmt/fmt.h>

#include "renderer/base/error.h"
#include "renderer/scene/ies/ies_profile.h"
#include "renderer/scene/ies/ies_table.h"

namespace lamplighter {

namespace {

constexpr size_t kMostBytes = 16u << 20;
constexpr double kMostCandela = 1e12;
constexpr const char* kRemedy = "give an unchanged IES file (LM-63) of the manufacturer";

class Parser {
 public:
  Parser(std::string_view text, const std::string& file) : text_(text), file_(file) {}

  std::shared_ptr<IesProfile> parse() {
    if (text_.size() > kMostBytes) fail("is larger than 16 MiB");
    auto out = std::make_shared<IesProfile>();
    readTilt(*out);
    out->file = file_;
    out->text = text_;
    number("a number of lamps");
    number("lumens");
    const double multiplier = number("a candela multiplier");
    const size_t rows = count("vertical angles"), columns = count("horizontal angles");
    const double type = number("a photometric type");
    if (type != 1.0 && type != 2.0) fail("has photometry of neither type B nor type C");
    out->isTypeB = type == 2.0;
    for (const char* what : {"units", "a width", "a length", "a height"}) number(what);
    const double ballast = number("a ballast factor");
    // 1986 and 1991 standards: ballast-lamp factor; later ones: reserved, 1.
    const double lamp = number("a ballast-lamp factor");
    number("watts");
    const double factor = multiplier * ballast * lamp;
    if (!(factor > 0.0 && factor < kMostCandela))
      fail("has a multiplier or ballast factor that is not above 0");
    // A number and its separator take at least two characters.
    if (rows + columns + rows * columns > (text_.size() - at_ + 1) / 2 + 1)
      fail("contains fewer numbers than it declares");
    out->vertical = angles(rows, "vertical angles");
    out->horizontal = angles(columns, "horizontal angles");
    checkAngles(*out);
    std::vector<double> candela(rows * columns);
    for (double& c : candela) {
      c = number("candela");
      if (c < 0.0) fail("has a candela value below 0");
    }
    const double most = *std::max_element(candela.begin(), candela.end());
    if (!(most > 0.0)) fail("has no candela value above 0");
    if (most * factor > kMostCandela) fail("has a candela value above 1e12");
    out->peak = static_cast<float>(most * factor);
    for (const double c : candela) out->values.push_back(static_cast<float>(c / most));
    return out;
  }

 private:
  [[noreturn]] void fail(const std::string& wrong) const {
    throw InputError(file_, wrong, kRemedy);
  }

  // Skips all lines up to TILT=, and reads the tilt data if present: the lamp's output by angle of
  // the luminaire from straight down. The factors were measured for one position of the lamp in the
  // luminaire (1: upright; 2: horizontal, level when the luminaire turns around its C0 axis; 3:
  // horizontal, turning with it). The angle is that of the luminaire in each case.
  void readTilt(IesProfile& out) {
    for (;;) {
      const size_t end = text_.find('\n', at_);
      std::string_view line = text_.substr(at_, end == kEnd ? kEnd : end - at_);
      while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\t'))
        line.remove_suffix(1);
      while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
      at_ = end == kEnd ? text_.size() : end + 1;
      if (line.starts_with("TILT=")) {
        const std::string_view what = line.substr(5);
        if (what == "NONE") return;
        if (what != "INCLUDE") fail("refers to another file for its tilt data");
        const double geometry = number("the lamp-to-luminaire geometry");
        if (geometry != 1.0 && geometry != 2.0 && geometry != 3.0)
          fail("has a lamp-to-luminaire geometry other than 1, 2 or 3");
        const size_t pairs = count("tilt angles");
        if (pairs > (text_.size() - at_) / 4 + 1) fail("contains fewer numbers than it declares");
        out.tiltAngles = angles(pairs, "tilt angles");
        for (size_t i = 0; i < pairs; ++i) {
          const double factor = number("tilt factors");
          if (!(factor >= 0.0 && factor <= 1000.0)) fail("has a tilt factor outside of 0 to 1000");
          out.tiltFactors.push_back(static_cast<float>(factor));
        }
        if (*std::max_element(out.tiltFactors.begin(), out.tiltFactors.end()) <= 0.0f)
          fail("has no tilt factor above 0");
        return;
      }
      if (end == kEnd) fail("has no line TILT=");
    }
  }

  double number(const char* what) {
    const auto parts = [](char c) {
      return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ',';
    };
    while (at_ < text_.size() && parts(text_[at_])) ++at_;
    if (at_ == text_.size()) fail(std::string("ends before ") + what);
    const char* begin = text_.data() + at_;
    if (*begin == '+') ++begin;
    double value = 0.0;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    at_ = static_cast<size_t>(end - text_.data());
    const bool isParted = at_ == text_.size() || parts(text_[at_]);
    if (error != std::errc() || !isParted || !std::isfinite(value))
      fail(std::string("has text or an invalid number instead of ") + what);
    return value;
  }

  size_t count(const char* what) {
    const double value = number(what);
    if (!(value >= 1.0 && value <= 100'000.0) || value != std::floor(value))
      fail(fmt::format("has an invalid number of {}", what));
    return static_cast<size_t>(value);
  }

  std::vector<float> angles(size_t size, const char* what) {
    std::vector<float> out;
    out.reserve(size);
    for (size_t i = 0; i < size; ++i) {
      const double angle = number(what);
      if (std::abs(angle) > 360.0) fail(std::string("has ") + what + " beyond 360 degrees");
      if (!out.empty() && !(static_cast<float>(angle) > out.back()))
        fail(std::string("has ") + what + " that do not increase");
      out.push_back(static_cast<float>(angle));
    }
    return out;
  }

  void checkAngles(const IesProfile& p) const {
    const float v0 = p.vertical.front(), v1 = p.vertical.back();
    const float h0 = p.horizontal.front(), h1 = p.horizontal.back();
    bool sound;
    if (p.isTypeB) {
      sound = (v0 == 0.0f || v0 == -90.0f) && v1 <= 90.0f && (h0 == 0.0f || h0 == -90.0f) &&
              h1 <= 90.0f;
    } else {
      const bool half = h0 == 90.0f && h1 == 270.0f;
      const bool planes = h0 == 0.0f && (h1 == 0.0f || h1 == 90.0f || h1 == 180.0f || h1 == 360.0f);
      sound = v0 >= 0.0f && v1 <= 180.0f && p.vertical.size() > 1 && (half || planes);
    }
    if (!sound) fail("has angles outside of the range of its photometric type");
  }

  static constexpr size_t kEnd = std::string_view::npos;
  std::string_view text_;
  const std::string& file_;
  size_t at_ = 0;
};

void integrate(IesProfile& p) {
  constexpr int kDegreesDown = 180, kDegreesAround = 360;
  double sum = 0.0;
  int last = 0;  // row with light
  for (int row = 0; row < kDegreesDown; ++row) {
    const double top = kPi * row / kDegreesDown, bottom = kPi * (row + 1) / kDegreesDown;
    const double weight = (std::cos(top) - std::cos(bottom)) * 2.0 * kPi / kDegreesAround;
    const auto theta = static_cast<float>(0.5 * (top + bottom));
    double values = 0.0;
    for (int column = 0; column < kDegreesAround; ++column) {
      const float phi = 2.0f * kPi * (static_cast<float>(column) + 0.5f) / kDegreesAround;
      const float s = std::sin(theta);
      values += p.at({s * std::cos(phi), s * std::sin(phi), -std::cos(theta)});
    }
    if (values > 0.0) last = row;
    sum += weight * values;
  }
  p.solidAngle = static_cast<float>(sum);
  p.cap = static_cast<float>(1.0 - std::cos(kPi * std::min(last + 2, kDegreesDown) / kDegreesDown));
}

}  // namespace

std::shared_ptr<IesProfile> parseIesTable(std::string_view text, const std::string& file) {
  return Parser(text, file).parse();
}

std::shared_ptr<const IesProfile> parseIes(std::string_view text, const std::string& file) {
  const std::shared_ptr<IesProfile> out = parseIesTable(text, file);
  integrate(*out);
  out->lobes = fitLobes([&](const vec3& direction) { return out->at(direction); });
  if (out->lobes.empty())
    throw InputError(file, "gives light in one or two directions only", kRemedy);
  return out;
}

std::shared_ptr<const IesProfile> readIes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string text;
  std::array<char, 4096> part{};
  while (in && text.size() <= kMostBytes) {
    in.read(part.data(), part.size());
    text.append(part.data(), static_cast<size_t>(in.gcount()));
  }
  if (text.empty()) throw InputError(path, "cannot be read, or is empty", kRemedy);
  const size_t slash = path.find_last_of("/\\");
  const std::string name = slash == std::string::npos ? path : path.substr(slash + 1);
  return parseIes(text, name);
}

}  // namespace lamplighter
