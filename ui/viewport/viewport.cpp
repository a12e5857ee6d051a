#include "ui/viewport/viewport.h"

#include <cmath>

#include "editor/debug_views/legend.h"
#include "ui/viewport/label_placement.h"
#include "ui/viewport/split_sides.h"
#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

ImU32 packed(const vec4& c) { return ImGui::ColorConvertFloat4ToU32({c.r, c.g, c.b, c.a}); }

std::vector<ImVec2> moved(const std::vector<vec2>& points, vec2 origin) {
  std::vector<ImVec2> result;
  result.reserve(points.size());
  for (const vec2& p : points) result.emplace_back(p.x + origin.x, p.y + origin.y);
  return result;
}

void drawShape(ImDrawList& list, const OverlayShape& shape, vec2 origin, float scale) {
  const std::vector<ImVec2> points = moved(shape.points, origin);
  const int count = static_cast<int>(points.size());
  const ImU32 colour = packed(shape.colour);
  if (shape.filled)
    list.AddConvexPolyFilled(points.data(), count, colour);
  else
    list.AddPolyline(points.data(), count, colour, shape.closed ? ImDrawFlags_Closed : 0,
                     shape.thickness * scale);
}

void drawShapes(ImDrawList& list, const Overlay& overlay, vec2 origin, float scale) {
  for (const OverlayShape& shape : overlay.shapes) drawShape(list, shape, origin, scale);
}

void drawMeshes(ImDrawList& list, const Overlay& overlay, vec2 origin) {
  const ImVec2 white = ImGui::GetFontTexUvWhitePixel();
  for (const OverlayMesh& mesh : overlay.meshes) {
    list.PrimReserve(static_cast<int>(mesh.triangles.size()), static_cast<int>(mesh.points.size()));
    const unsigned first = list._VtxCurrentIdx;
    for (const uint32_t i : mesh.triangles) list.PrimWriteIdx(static_cast<ImDrawIdx>(first + i));
    for (size_t i = 0; i < mesh.points.size(); ++i)
      list.PrimWriteVtx({mesh.points[i].x + origin.x, mesh.points[i].y + origin.y}, white,
                        packed(mesh.colours[i]));
  }
}

// Texts with a background are kept within `area` and away from `covered`.
void drawTexts(ImDrawList& list, const Overlay& overlay, vec2 origin, float scale, const Rect& area,
               const std::vector<Rect>& covered) {
  for (const OverlayText& text : overlay.texts) {
    ImVec2 at{text.position.x + origin.x, text.position.y + origin.y};
    if (text.boxed) {
      const ImVec2 size = ImGui::CalcTextSize(text.text.c_str());
      const float pad = 5.0f * scale;
      const Rect plate = clearPlace(
          {{at.x - pad, at.y - pad}, {at.x + size.x + pad, at.y + size.y + pad}}, area, covered);
      list.AddRectFilled({plate.min.x, plate.min.y}, {plate.max.x, plate.max.y},
                         theme::colour(theme::kBackground, 200), 4.0f * scale);
      at = {plate.min.x + pad, plate.min.y + pad};
    }
    list.AddText({at.x + 1, at.y + 1}, theme::colour(0, 160), text.text.c_str());
    list.AddText(at, packed(text.colour), text.text.c_str());
  }
}

void drawPicture(ImDrawList& list, const Rect& area, uint32_t texture) {
  const ImVec2 low{area.min.x, area.min.y}, high{area.max.x, area.max.y};
  if (texture != 0)
    list.AddImage(reinterpret_cast<ImTextureID>(static_cast<intptr_t>(texture)), low, high);
  else
    list.AddRectFilled(low, high, theme::colour(0x000000));
}

// In the lower left corner.
void drawLegend(const PanelContext& ui, ImDrawList& list, const Rect& area,
                const ViewPicture& picture) {
  const LegendStyle style{ui.scale, ImGui::GetTextLineHeight(), [](const std::string& text) {
                            return ImGui::CalcTextSize(text.c_str()).x;
                          }};
  const LegendLayout legend = layOutLegend(picture, style, 0.0f);
  if (legend.size == vec2(0.0f)) return;
  const float pad = ui.px(10);
  const vec2 low(area.min.x + pad, area.max.y - 3 * pad - legend.size.y);
  const vec2 high = low + legend.size + 2 * pad;
  list.AddRectFilled({low.x, low.y}, {high.x, high.y}, theme::colour(theme::kBackground, 240),
                     ui.px(5));
  list.AddRect({low.x, low.y}, {high.x, high.y}, theme::colour(theme::kLine), ui.px(5));
  drawShapes(list, legend.overlay, low + pad, ui.scale);
  drawTexts(list, legend.overlay, low + pad, ui.scale, area, {});
}

}  // namespace

void Viewport::takeInput(PanelContext ui, const Rect& area, const PointerKeys& input,
                         float seconds) {
  area_ = area;
  const vec2 size = glm::max(area.size(), vec2(16.0f));
  ui.session.split().setLineHeight(ImGui::GetTextLineHeight());
  ui.session.resizeViewport(static_cast<int>(std::lround(size.x)),
                            static_cast<int>(std::lround(size.y)));
  ImGui::SetNextWindowPos({area.min.x, area.min.y});
  ImGui::SetNextWindowSize({size.x, size.y});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  ImGui::Begin("##viewport", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground |
                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoBringToFrontOnFocus |
                   ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNavInputs);
  ImGui::PopStyleVar();
  ImGui::InvisibleButton("view", {size.x, size.y},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  ui.prefix.clear();
  ui.name(kViewportTarget);
  const bool hovered = ImGui::IsItemHovered();
  ImGui::End();

  ViewportInput in;
  in.pointer = input.pointer - area.min;
  in.hovered = hovered;
  for (int i = 0; i < 3; ++i) {
    in.pressed[i] = hovered && ImGui::IsMouseClicked(i);
    in.released[i] = down_[i] && !input.buttons[static_cast<size_t>(i)];
    if (in.pressed[i]) down_[i] = true;
    if (in.released[i]) down_[i] = false;
    in.down[i] = down_[i];
  }
  in.doubleClicked = hovered && ImGui::IsMouseDoubleClicked(0);
  in.wheel = hovered ? input.wheel.y : 0.0f;
  if (!ImGui::GetIO().WantTextInput)
    for (size_t i = 1; i < input.keys.size(); ++i)
      if (input.keys[i]) in.keys.insert(static_cast<Key>(i));
  in.modifiers = input.modifiers();
  in.seconds = seconds;
  ui.session.viewport(in);
}

// The overlay is drawn over each tile, so that any of them can be worked in.
void Viewport::drawTiles(const PanelContext& ui, ImDrawList& list,
                         std::span<const uint32_t> textures) const {
  const TileLayout layout = ui.session.tiles();
  const Overlay overlay = ui.session.overlay();
  list.AddRectFilled({area_.min.x, area_.min.y}, {area_.max.x, area_.max.y},
                     theme::colour(theme::kBackground));
  for (int i = 0; i < layout.count; ++i) {
    const auto side = static_cast<size_t>(i);
    const vec2 low = area_.min + layout.origin(i), high = low + vec2(layout.size);
    list.PushClipRect({low.x, low.y}, {high.x, high.y}, true);
    drawPicture(list, {low, high}, side < textures.size() ? textures[side] : 0);
    drawMeshes(list, overlay, low);
    drawShapes(list, overlay, low, ui.scale);
    drawTexts(list, overlay, low, ui.scale, {low, high}, covered_);
    list.PopClipRect();
    drawTileCaption(list, {{low.x, high.y}, {high.x, area_.max.y}}, ui.session.split(), side);
  }
}

void Viewport::draw(PanelContext ui, std::span<const uint32_t> textures) const {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 low{area_.min.x, area_.min.y}, high{area_.max.x, area_.max.y};
  list.PushClipRect(low, high, true);
  const SplitView& split = ui.session.split();
  if (split.showsTiles()) {
    drawTiles(ui, list, textures);
    list.PopClipRect();
    return;
  }
  drawPicture(list, area_, textures.empty() ? 0 : textures.front());
  if (split.on() && textures.size() > 1) drawSecondSide(ui, list, area_, split, textures[1]);
  const Overlay overlay = ui.session.overlay();
  drawMeshes(list, overlay, area_.min);
  drawShapes(list, overlay, area_.min, ui.scale);
  drawTexts(list, overlay, area_.min, ui.scale, area_, covered_);
  if (split.on()) drawSplitLabels(ui, list, area_, split);
  if (split.on() && split.heat())
    drawLegend(ui, list, area_, *split.heat());
  else if (const auto& view = ui.session.display().picture())
    drawLegend(ui, list, area_, *view);
  list.PopClipRect();
}

}  // namespace lamplighter
