// Building blocks of panels: named widgets, labelled rows, and fields whose drag is one undo step.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <imgui.h>

#include "editor/session/session.h"
#include "ui/widgets/widget_map.h"

namespace lamplighter {

// The arguments of every panel.
struct PanelContext {
  Session& session;
  WidgetMap& widgets;
  float scale = 1.0f;  // pixels per design pixel
  std::string prefix;  // prefix of the widget names: "inspector/"

  float px(float designPixels) const;
  // Gives the last ImGui item a name for recordings.
  void name(const std::string& widget) const;
};

// Starts a row "label  [field……]": draws the label, moves the cursor to the field and sets its
// width.
void labelledRow(const PanelContext& ui, const char* label, const char* help = nullptr);
// Width of the label column.
float labelWidth(const PanelContext& ui);
// A tooltip for the last item, shown after a short delay, with line wrapping.
void tooltip(const PanelContext& ui, const std::string& text);
// A collapsible section header, named "section LABEL".
bool section(const PanelContext& ui, const char* label, bool openAtFirst = true);
// The rectangle of the current ImGui window.
Rect windowRect();
// A modal popup with a border, to separate it from panels of the same colour.
bool beginBorderedModal(const char* title, ImGuiWindowFlags flags);
// Removes as much of the beginning of `text` as needed to fit: "…/scenes/halls".
std::string endOf(const std::string& text, float room);
// One line of text in a colour of the theme, at the cursor or at the right edge.
void colouredText(const std::string& text, unsigned colour);
void rightAligned(const std::string& text, unsigned colour);
// Height of `rows` rows of a table with one line of text each.
float heightOfRows(const PanelContext& ui, float rows);
// Begins a panel over the view, at the next window's position and size.
void beginOverlay(const PanelContext& ui, const char* id);
// Dimmed text with line wrapping.
void note(const std::string& text);
// "icon  label", or only the label if there is no icon font.
std::string withIcon(const char* icon, const std::string& label);

// Makes the edits of the last ImGui item one undo step: opens a transaction when the item becomes
// active and commits it when it becomes inactive. Call it after the item and before the edit.
void trackEdit(const PanelContext& ui, const std::string& label);

// A field for one component with a coloured edge: "x 1.25". Returns true if it changed.
bool dragField(const PanelContext& ui, const std::string& widget, float& value, float speed,
               const char* format, float minimum = 0.0f, float maximum = 0.0f);
// Three such fields side by side, named WIDGET.x, .y, .z.
bool dragVector(const PanelContext& ui, const std::string& widget, const std::string& step,
                vec3& value, float speed, const char* format);

// Colours are linear in the document and sRGB-encoded on the screen.
vec3 linearToSrgb(const vec3& c);
vec3 srgbToLinear(const vec3& c);

// A combo box, named WIDGET; its items are named WIDGET/NAME. `shown` is its text. Returns the
// index of the item that the user chose in this frame, or kNone.
struct ComboItem {
  std::string name, label, help = {};
  bool enabled = true;
};
int combo(const PanelContext& ui, const std::string& widget, const std::string& shown,
          std::span<const ComboItem> items, int current);
// The same for choices that are their own labels.
int combo(const PanelContext& ui, const std::string& widget, const std::string& shown,
          std::span<const std::string> choices);
// A button that is highlighted while its option is on.
bool toggleButton(const std::string& label, bool on, const ImVec2& size = {0, 0});

// "1,234,567"
std::string grouped(long long value);
// Three significant digits, grouped: "0.0123", "12.3", "12,300".
std::string short3(double value);

}  // namespace lamplighter
