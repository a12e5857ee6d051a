// Small building blocks of panels: named widgets, labelled rows, edits that are one undo step a
// drag.
#pragma once

#include <string>

#include <imgui.h>

#include "editor/session/session.h"
#include "ui/widgets/widget_map.h"

namespace lamplighter {

// What every panel is given.
struct PanelContext {
  Session& session;
  WidgetMap& widgets;
  float scale = 1.0f;  // pixels a design pixel
  std::string prefix;  // of the names of the widgets, "inspector/"

  float px(float designPixels) const;
  // Gives the last ImGui item a name that recordings can use.
  void name(const std::string& widget) const;
};

// A row "label  [field……]": writes the label and leaves the cursor at the field with its width set.
void labelledRow(const PanelContext& ui, const char* label, const char* help = nullptr);
// Width of the label column.
float labelWidth(const PanelContext& ui);
// A tooltip for the last item, shown after a short wait, wrapped.
void tooltip(const PanelContext& ui, const std::string& text);
// A section header that opens and closes; named "section LABEL".
bool section(const PanelContext& ui, const char* label, bool openAtFirst = true);
// Of the ImGui window that is being filled.
Rect windowRect();
// A modal popup with an edge, since it may lie upon panels of its own colour.
bool beginBorderedModal(const char* title, ImGuiWindowFlags flags);
// `text` without as much of its beginning as there is no room for: "\u2026/scenes/halls".
std::string endOf(const std::string& text, float room);
// Dim text, wrapped.
void note(const std::string& text);
// "icon  label", or the label alone where there is no icon font.
std::string withIcon(const char* icon, const std::string& label);

// Makes the edits of the last ImGui item one undoable step: begins a transaction where the item
// becomes active and commits it where it is left. Call it after the item, before the edit is made.
void trackEdit(const PanelContext& ui, const std::string& label);

// One component field with a coloured edge: "x 1.25". True when it changed.
bool dragField(const PanelContext& ui, const std::string& widget, float& value, float speed,
               const char* format, float minimum = 0.0f, float maximum = 0.0f);
// Three of them side by side, named WIDGET.x, .y, .z.
bool dragVector(const PanelContext& ui, const std::string& widget, const std::string& step,
                vec3& value, float speed, const char* format);

// Colours are linear in the document and shown sRGB-encoded.
vec3 linearToSrgb(const vec3& c);
vec3 srgbToLinear(const vec3& c);

// "1,234,567"
std::string grouped(long long value);
// Three significant digits, grouped: "0.0123", "12.3", "12,300".
std::string short3(double value);

}  // namespace lamplighter
