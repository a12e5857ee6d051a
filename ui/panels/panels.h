// The panels, one function each; called every frame within an ImGui window that app/layout made.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "ui/widgets/widgets.h"

namespace lamplighter {

// What panels ask of the application, which does it after the frame.
struct Requests {
  bool openDialog = false;
  bool saveDialog = false;
  bool timelineDialog = false;
  bool folderDialog = false;         // of assets
  std::vector<std::string> actions;  // to run, as text
  std::string palette;               // open the command palette with this in it
};

void menuBar(PanelContext ui, Requests& requests);
void toolbar(PanelContext ui, Requests& requests);

struct OutlinerState {
  std::string search;
  NodeId scrolledTo = kNoNode;
  NodeId pressed = kNoNode;  // one of several that are selected, until it is let go or dragged
};
void outliner(PanelContext ui, OutlinerState& state);

struct InspectorState {
  NodeId node = kNoNode;
  std::string name;    // being typed
  vec3 degrees{0.0f};  // of the rotation below, as the fields show it
  quat rotation{1, 0, 0, 0};
  int slot = 0;                 // which of the mesh's materials
  bool focusName = false;       // give the name field the keyboard
  bool choosesSky = false;      // a file dialog for the sky's picture is wanted
  bool choosesProfile = false;  // one for the light's profile
  bool choosesPicture = false;  // one for its picture
  std::string linkSearch;       // among what it may leave out
};
void inspector(PanelContext ui, InspectorState& state);
// Parts of the inspector.
void transformFields(PanelContext ui, const Node& node, InspectorState& state);
void materialFields(PanelContext ui, const Node& node, InspectorState& state);
void areaLightFields(PanelContext ui, const Node& node, InspectorState& state);
void punctualLightFields(PanelContext ui, const Node& node, InspectorState& state);
void profileFields(const PanelContext& ui, const Node& node,
                   InspectorState& state);  // of an IES file
void pictureFields(const PanelContext& ui, const Node& node, InspectorState& state);
// What a light, or the sky (kNoNode), leaves out; and the same of the selected lights.
void linkFields(const PanelContext& ui, NodeId light, InspectorState& state);
void selectedLinkFields(const PanelContext& ui);
void skyFields(PanelContext ui, InspectorState& state);
// Instead of all these while several objects are selected: what they have in common.
void multiInspector(PanelContext ui, InspectorState& state);

struct TimelineState {
  std::optional<Timeline> held;  // what is pointed at
};
void renderPanel(PanelContext ui, TimelineState& state, Requests& requests);
void compareSection(const PanelContext& ui, Requests& requests);
void timelineSection(const PanelContext& ui, TimelineState& state, Requests& requests);
// The method's parameters of a group under a header that opens; nothing where it has none of them.
void parameterSection(const PanelContext& ui, const MethodInfo& method, ParameterGroup group);

// How often each brightness is in the picture, with exposure and tone mapper: a window in the lower
// right corner of `view`, while it is asked for. What it covers.
Rect histogramPanel(PanelContext ui, const Rect& view, Requests& requests);

// Why the point that was clicked is as dark as it is; a window in the upper right corner of `view`,
// while there is such a point. What it covers.
Rect explainPanel(PanelContext ui, const Rect& view, Requests& requests);

// The steps of the history, a click on one goes there; a window in the lower left corner of `view`,
// while it is asked for. What it covers.
Rect historyPanel(PanelContext ui, const Rect& view, Requests& requests);

struct StatusInfo {
  double frameSeconds = 0.0;  // smoothed
  bool recording = false;
  bool replaying = false;
};
void statusLine(PanelContext ui, const StatusInfo& info);

// Modal dialogs. They are opened by a call and draw themselves each frame.

// A message with an OK button.
class MessageBox {
 public:
  void show(std::string title, std::string text);
  bool visible() const { return !text_.empty(); }
  void draw(PanelContext ui);

 private:
  std::string title_, text_;
};

// "Save changes?" before something that would lose them.
class SaveQuestion {
 public:
  enum class Answer { none, save, discard, cancel };
  void ask() { opening_ = true; }
  Answer draw(PanelContext ui);

 private:
  bool opening_ = false;
};

// "It was changed by others. Overwrite?"
class OverwriteQuestion {
 public:
  enum class Answer { none, overwrite, saveAs, cancel };
  void ask(const std::string& changed) { changed_ = changed; }
  Answer draw(PanelContext ui);

 private:
  std::string changed_;  // the file; empty: nothing is asked
};

// A line of text in the middle of the window.
void centredNotice(float scale, const char* text);

// A bar over everything while long work runs.
struct Progress {
  std::string title, what;
  float done = 0.0f;
  bool cancellable = true;
};
class ProgressBox {
 public:
  // nullptr: nothing runs, so it closes. True when Cancel was clicked.
  bool draw(PanelContext ui, const Progress* progress);

 private:
  bool shown_ = false;
};

}  // namespace lamplighter
