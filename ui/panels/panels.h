// The panels, one function each. They are called every frame within an ImGui window that app/layout
// placed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ui/widgets/widgets.h"

namespace lamplighter {

// Requests of panels to the application, which handles them after the frame.
struct Requests {
  std::vector<std::string> actions;  // action texts to run
  std::string palette;               // opens the command palette with this text
};

void menuBar(PanelContext ui, Requests& requests);
void toolbar(PanelContext ui, Requests& requests);

struct OutlinerState {
  std::string search;
  NodeId scrolledTo = kNoNode;
  NodeId pressed = kNoNode;  // pressed item of a multiple selection, until release or drag
};
void outliner(PanelContext ui, OutlinerState& state);

struct InspectorState {
  NodeId node = kNoNode;
  std::string name;    // typed text
  vec3 degrees{0.0f};  // of the rotation below, as displayed
  quat rotation{1, 0, 0, 0};
  int slot = 0;            // index into the mesh's material slots
  std::string linkSearch;  // filters the objects of light linking
};
void inspector(PanelContext ui, InspectorState& state, Requests& requests);
// Parts of the inspector.
void transformFields(PanelContext ui, const Node& node, InspectorState& state);
void materialFields(PanelContext ui, const Node& node, InspectorState& state);
void areaLightFields(PanelContext ui, const Node& node, Requests& requests);
void punctualLightFields(PanelContext ui, const Node& node, Requests& requests);
void profileFields(const PanelContext& ui, const Node& node, Requests& requests);  // for IES files
void pictureFields(const PanelContext& ui, const Node& node, Requests& requests);
// A button that chooses a file by an action and, if there is one, a button that removes it. `what`:
// prefix of the widgets. `file`: null if there is none. Returns whether there is one.
bool fileButtons(const PanelContext& ui, const std::string& what, const std::string& action,
                 const std::string* file, Requests& requests);
std::span<const ComboItem> meshKindItems();  // in the order of MeshKind
// The objects that a light, or the sky (kNoNode), excludes by light linking; and the same for all
// selected lights.
void linkFields(const PanelContext& ui, NodeId light, InspectorState& state);
void selectedLinkFields(const PanelContext& ui);
void skyFields(PanelContext ui, InspectorState& state, Requests& requests);
// Replaces the other parts while several objects are selected: shows their common values.
void multiInspector(PanelContext ui, InspectorState& state);

struct TimelineState {
  std::optional<Timeline> held;  // the frames under the pointer, kept while it is there
};
void renderPanel(PanelContext ui, TimelineState& state, Requests& requests);
void compareSection(const PanelContext& ui, Requests& requests);
void timelineSection(const PanelContext& ui, TimelineState& state, Requests& requests);
// The field of a parameter, from its declaration. `tracks`: a drag is one undo step of the
// document. Returns the new value if it changed.
std::optional<ParameterValue> parameterField(const PanelContext& ui, const ParameterSpec& spec,
                                             const Settings& settings, bool tracks);
// A row for a parameter of the document, with its cost if it is a budget. Right-click resets it.
void parameterRow(const PanelContext& ui, const MethodInfo& method, const ParameterSpec& spec);
// The method's parameters of a group except the named ones, under a collapsible header that is
// closed at first. Draws nothing if none is left.
void parameterSection(const PanelContext& ui, const MethodInfo& method, ParameterGroup group,
                      std::span<const std::string_view> except);

// Histogram of the picture's brightness, with exposure and tone mapper: a window in the lower right
// corner of `view`, if it is switched on. Returns the covered rectangle.
Rect histogramPanel(PanelContext ui, const Rect& view, Requests& requests);

// Explains the brightness of the clicked point: a window in the upper right corner of `view`, while
// there is such a point. Returns the covered rectangle.
Rect explainPanel(PanelContext ui, const Rect& view, Requests& requests);
// A part of that panel: the surfaces that reflect light to the point; up to `mostRows` rows without
// scrolling.
void senderRows(const PanelContext& ui, float mostRows, Requests& requests);

// The steps of the history; a click on a step goes there. A window in the lower left corner of
// `view`, if it is switched on. Returns the covered rectangle.
Rect historyPanel(PanelContext ui, const Rect& view, Requests& requests);

struct StatusInfo {
  double frameSeconds = 0.0;  // smoothed
  bool recording = false;
  bool replaying = false;
};
void statusLine(PanelContext ui, const StatusInfo& info);

// Modal dialogs. A call opens them; they draw themselves in each frame.

// A message with an OK button.
class MessageBox {
 public:
  void show(std::string title, std::string text);
  bool visible() const { return !text_.empty(); }
  void draw(PanelContext ui);

 private:
  std::string title_, text_;
};

// Asks "Save changes?" before an operation that would lose them.
class SaveQuestion {
 public:
  enum class Answer { none, save, discard, cancel };
  void ask() { opening_ = true; }
  Answer draw(PanelContext ui);

 private:
  bool opening_ = false;
};

// Asks whether to overwrite a file that another program changed.
class OverwriteQuestion {
 public:
  enum class Answer { none, overwrite, saveAs, cancel };
  void ask(const std::string& changed) { changed_ = changed; }
  Answer draw(PanelContext ui);

 private:
  std::string changed_;  // the changed file; empty: the dialog is closed
};

// Asks for the name that an action needs.
class NameDialog {
 public:
  void open(const std::string& action, const ActionAsk& asks, std::string name);
  // The text of the action with the confirmed name, once; "": none yet.
  std::string draw(PanelContext ui);

 private:
  std::string action_, title_, name_;
  bool opening_ = false;
};

// A line of text in the middle of the window.
void centredNotice(float scale, const char* text);

// A progress bar over all panels during a long operation.
struct Progress {
  std::string title, what;
  float done = 0.0f;
  bool cancellable = true;
};
class ProgressBox {
 public:
  // nullptr: no operation runs, and the dialog closes. Returns true if Cancel was clicked.
  bool draw(PanelContext ui, const Progress* progress);

 private:
  bool shown_ = false;
};

}  // namespace lamplighter
