#include "editor/debug_views/legend.h"

#include <algorithm>

#include "editor/debug_views/look.h"

namespace lamplighter {
namespace {

class Layout {
 public:
  Layout(const LegendStyle& style, float width)
      : style_(style), width_(width), line_(style.textHeight + px(4)) {}

  float px(float designPixels) const { return designPixels * style_.scale; }
  float textWidth(const std::string& text) const { return style_.textWidth(text); }
  float square() const { return style_.textHeight - px(2); }

  // Reserves space for the next item, in this row or a new one. Returns its upper left corner.
  vec2 place(float width, float lines) {
    const bool fits = rowHeight_ > 0.0f && cursor_.x + width <= width_;
    if (!fits) {
      cursor_ = vec2(0.0f, cursor_.y + rowHeight_);
      rowHeight_ = 0.0f;
    }
    const vec2 at = cursor_;
    cursor_.x += width + px(18);
    rowHeight_ = std::max(rowHeight_, lines * line_);
    out_.size = glm::max(out_.size, vec2(at.x + width, cursor_.y + rowHeight_ - px(4)));
    return at;
  }
  void text(const vec2& at, const std::string& text, unsigned colour) {
    out_.overlay.texts.push_back({at, text, look::colour(colour)});
  }
  void box(const vec2& low, const vec2& high, const vec4& colour, bool filled = true) {
    out_.overlay.shapes.push_back(
        {{low, {high.x, low.y}, high, {low.x, high.y}}, true, filled, colour, 1.0f});
  }
  float line() const { return line_; }
  LegendLayout take() { return std::move(out_); }

 private:
  const LegendStyle& style_;
  float width_, line_;
  vec2 cursor_{0.0f};
  float rowHeight_ = 0.0f;
  LegendLayout out_;
};

void addRamp(Layout& layout, const Legend& legend) {
  constexpr int kBands = 95;
  const float width = layout.px(190);
  const vec2 at = layout.place(width, 2.0f);
  const vec2 high = at + vec2(width, layout.square());
  const auto last = static_cast<float>(legend.ramp.size() - 1);
  // Each band extends to the end, below the following bands. This avoids seams at antialiased
  // edges.
  for (int i = 0; i < kBands; ++i) {
    const float t = static_cast<float>(i) / (kBands - 1) * last;
    const auto step = std::min(static_cast<size_t>(t), legend.ramp.size() - 2);
    const vec3 colour =
        glm::mix(legend.ramp[step], legend.ramp[step + 1], t - static_cast<float>(step));
    layout.box({at.x + width * static_cast<float>(i) / kBands, at.y}, high, vec4(colour, 1.0f));
  }
  const float below = at.y + layout.line();
  for (const auto& [t, label] : legend.ticks) {
    const float middle = at.x + t * width;
    const float half = 0.5f * layout.textWidth(label);
    // The first and last labels stay within the ramp.
    const float left = std::clamp(middle - half, at.x, std::max(at.x, high.x - 2.0f * half));
    layout.text({left, below}, label, look::kTextDim);
    if (t > 0.0f && t < 1.0f)
      layout.box({middle - 0.5f, high.y - layout.px(4)}, {middle + 0.5f, high.y},
                 look::colour(look::kBackground));
  }
  if (!legend.ticks.empty()) return;
  layout.text({at.x, below}, legend.low, look::kTextDim);
  layout.text({high.x - layout.textWidth(legend.high), below}, legend.high, look::kTextDim);
}

void addSwatch(Layout& layout, const Legend::Swatch& swatch) {
  const float gap = layout.px(7), side = layout.square();
  const vec2 at = layout.place(side + gap + layout.textWidth(swatch.label), 1.0f);
  layout.box(at, at + side, vec4(swatch.colour, 1.0f));
  layout.box(at, at + side, look::colour(look::kTextDim, 0.5f), false);
  layout.text({at.x + side + gap, at.y}, swatch.label, look::kTextDim);
}

}  // namespace

LegendLayout layOutLegend(const ViewPicture& picture, const LegendStyle& style, float width) {
  Layout layout(style, width);
  const auto title = [&](const std::string& text, unsigned colour) {
    layout.text(layout.place(layout.textWidth(text), 1.0f), text, colour);
  };
  const Legend& legend = picture.legend;
  if (!picture.problem.empty()) {
    title("Not shown: " + picture.problem, look::kWarning);
  } else if (!legend.empty()) {
    title(legend.title, look::kText);
    if (legend.ramp.size() > 1) addRamp(layout, legend);
    for (const Legend::Swatch& swatch : legend.swatches) addSwatch(layout, swatch);
  }
  return layout.take();
}

}  // namespace lamplighter
