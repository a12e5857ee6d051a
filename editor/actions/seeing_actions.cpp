// Actions that inspect the picture: why a point is dark, its brightness, its distance from another.
#include <cmath>

#include "editor/actions/arguments.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "renderer/base/error.h"

namespace lamplighter {
namespace {

vec2 pixelOf(const Arguments& a) { return {numberOf(a[0]), numberOf(a[1])}; }

int rowOf(const std::string& text) {
  const float number = numberOf(text);
  if (number != std::floor(number) || std::abs(number) > 1e6f)
    throw InputError(text, "is not a whole number", "give one such as 0");
  return static_cast<int>(number);
}

vec2 pointerOf(const Session& s) {
  if (const auto at = s.pointer()) return *at;
  throw InputError("pointer", "it has not been over the picture yet", "point at a surface");
}

void explainAt(Session& s, const vec2& pixel) { s.points().explainAt(s.pointSubject(), pixel); }

void addExplain(ActionRegistry& r) {
  r.add({"explain.at", "Why is it dark at", "X Y",
         "Lists the contribution of each light at a viewport pixel, and its occluders.", "",
         [](Session& s, const Arguments& a) { explainAt(s, pixelOf(a)); }});
  r.add(
      {"explain.pointer", "Why is it dark here?", "",
       "Lists the contribution of each light at the surface under the pointer, and its occluders.",
       "Y", [](Session& s, const Arguments&) { explainAt(s, pointerOf(s)); }});
  r.add({"explain.light", "Show light's rays", "ROW",
         "Draws the rays between the explained point and a light, by its row from 0.", "",
         [](Session& s, const Arguments& a) { s.points().explainer().choose(rowOf(a[0])); }});
  r.add(
      {"explain.blocker", "Select an occluder of a light", "ROW [INDEX]",
       "Selects an occluder between the explained point and a light. Rows and indices start at 0.",
       "", [](Session& s, const Arguments& a) {
         s.select({s.points().explainer().blocker(rowOf(a[0]), a.size() > 1 ? rowOf(a[1]) : 0)});
       }});
  r.add({"explain.sender", "Show the light of a surface", "ROW",
         "Draws lines from the explained point to a surface that reflects light to it, by its row "
         "from 0.",
         "",
         [](Session& s, const Arguments& a) { s.points().explainer().chooseSender(rowOf(a[0])); }});
  r.add({"explain.senders", "Show where bounced light comes from", "",
         "Draws lines from the explained point to the surfaces that reflect light to it.", "",
         [](Session& s, const Arguments&) { s.points().explainer().chooseAllSenders(); }});
  r.add({"explain.sender_object", "Select an object that reflects light", "ROW",
         "Selects the object that reflects light to the explained point, by its row from 0.", "",
         [](Session& s, const Arguments& a) {
           s.select({s.points().explainer().senderObject(rowOf(a[0]))});
         }});
  r.add({"explain.close", "Close the explanation", "",
         "Closes the list of light contributions and occluders.", "",
         [](Session& s, const Arguments&) { s.points().explainer().close(); },
         [](const Session& s) { return s.points().explainer().answer() != nullptr; }});
}

void addTool(ActionRegistry& r, const char* name, const char* label, const char* help,
             const char* key, PointTool tool) {
  r.add({name, label, "", help, key,
         [tool](Session& s, const Arguments&) {
           s.points().setTool(s.points().tool() == tool ? PointTool::none : tool);
         },
         nullptr, false, [tool](const Session& s) { return s.points().tool() == tool; }});
}

void addProbe(ActionRegistry& r) {
  r.add({"probe.at", "Probe at", "X Y",
         "Shows illuminance and luminance at a viewport pixel in the status line.", "",
         [](Session& s, const Arguments& a) {
           const vec2 pixel = pixelOf(a);
           s.setStatus(readingText(s.points().probeAt(s.pointSubject(), pixel)));
         }});
  r.add({"view.probe", "Probe", "", "Shows illuminance (lx) and luminance (nt) under the pointer.",
         "I",
         [](Session& s, const Arguments&) { s.points().probePointer(!s.points().probesPointer()); },
         nullptr, true, [](const Session& s) { return s.points().probesPointer(); }});
}

void addMeasure(ActionRegistry& r) {
  r.add({"measure.start", "Start measuring", "",
         "Starts the measuring tool: two clicks on surfaces measure a distance.", "",
         [](Session& s, const Arguments&) {
           s.points().setTool(PointTool::measure);
           s.points().measurement().clear();
         }});
  r.add({"measure.at", "Measure at", "X Y",
         "Sets the next end point of the measured distance at a viewport pixel.", "",
         [](Session& s, const Arguments& a) {
           s.points().measureAt(s.pointSubject(), pixelOf(a));
           if (s.points().measurement().isComplete()) s.setStatus(s.points().measurement().text());
         }});
  r.add({"measure.clear", "Clear the measurement", "",
         "Removes the measured distance from the viewport.", "",
         [](Session& s, const Arguments&) { s.points().measurement().clear(); },
         [](const Session& s) { return s.points().measurement().hasBegun(); }});
}

}  // namespace

void addSeeingActions(ActionRegistry& r) {
  addTool(r, "tool.explain", "Why is it dark?",
          "A click lists the contribution of each light at that point, and its occluders.",
          "Shift+Y", PointTool::explain);
  addTool(r, "tool.measure", "Measure", "Two clicks on surfaces show the distance between them.",
          "M", PointTool::measure);
  addExplain(r);
  addProbe(r);
  addMeasure(r);
}

}  // namespace lamplighter
