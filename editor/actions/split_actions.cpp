// Actions of the split view: two pictures side by side, and their difference.
#include <map>

#include "editor/actions/arguments.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "renderer/base/error.h"

namespace lamplighter {
namespace {

bool isOn(const Session& s) { return s.split().on(); }

// Switches the split view on with the live picture and the reference, unless it is on already.
void makeSureOfSplit(Session& s) {
  const std::string& method = s.document().render.method;
  if (!s.split().on()) s.split().turnOn(readSide("live", method), readSide("reference", method));
}

}  // namespace

void addSplitActions(ActionRegistry& r) {
  r.add({"split.on", "Split view", "[A B]",
         "Shows two pictures of the view, A left and B right of a divider. Each is live or the "
         "name of a method, with optional parameters (many_lights,vpls=1000). Default: the live "
         "picture and the reference. Both pictures are rendered, which costs time.",
         "Shift+Space",
         [](Session& s, const Arguments& a) {
           if (a.empty()) {
             makeSureOfSplit(s);
             s.split().setShown(SplitView::Shown::both);
             return;
           }
           const std::string& method = s.document().render.method;
           SplitSide first = readSide(a[0], method), second = readSide(a[1], method);
           s.split().turnOn(std::move(first), std::move(second));
         },
         nullptr, true,
         [](const Session& s) { return isOn(s) && s.split().shown() == SplitView::Shown::both; }});
  r.add({"split.off", "One picture", "", "Ends the split view.", "",
         [](Session& s, const Arguments&) { s.split().turnOff(); }, isOn, true});
  r.add({"split.position", "Move the divider", "SHARE",
         "Sets the position of the split view's divider, from 0 (left) to 1 (right).", "",
         [](Session& s, const Arguments& a) {
           const float share = numberOf(a[0]);
           if (share < 0.0f || share > 1.0f)
             throw InputError(a[0], "is not a share of the width", "give one from 0 to 1");
           s.split().setPosition(share);
           s.split().setShown(SplitView::Shown::both);
         },
         isOn, true});
  r.add({"split.toggle", "Show the other side", "",
         "Shows one side of the split view in the whole view, then the other.", "",
         [](Session& s, const Arguments&) { s.split().toggleWhole(); }, isOn, true});
  r.add({"split.show", "Compare", "off|both|first|second|heat",
         "Sets what the split view shows: the live picture, both sides, one side, or their "
         "difference.",
         "",
         [](Session& s, const Arguments& a) {
           using Shown = SplitView::Shown;
           static const std::map<std::string, Shown> kShown = {{"both", Shown::both},
                                                               {"first", Shown::first},
                                                               {"second", Shown::second},
                                                               {"heat", Shown::heat}};
           if (a[0] == "off") return s.split().turnOff();
           const auto shown = kShown.find(a[0]);
           if (shown == kShown.end())
             throw InputError(a[0], "is not a mode of the split view",
                              "give off, both, first, second or heat");
           makeSureOfSplit(s);
           s.split().setShown(shown->second);
         },
         nullptr, true});
  r.add({"split.heat", "Heat map", "",
         "Shows the difference of the two sides of the split view in false colour. If the split "
         "view is off, it compares the live picture with the reference.",
         "",
         [](Session& s, const Arguments&) {
           if (s.split().on() && s.split().shown() == SplitView::Shown::heat)
             return s.split().setShown(SplitView::Shown::both);
           makeSureOfSplit(s);
           s.split().setShown(SplitView::Shown::heat);
         },
         nullptr, true,
         [](const Session& s) { return isOn(s) && s.split().shown() == SplitView::Shown::heat; }});
  r.add(
      {"split.heat_scale", "Heat map's range", "SHARE",
       "Sets the difference at the end of the heat map's colour scale, relative to the mean of B.",
       "",
       [](Session& s, const Arguments& a) {
         const float share = numberOf(a[0]);
         if (share < 0.001f || share > 100.0f)
           throw InputError(a[0], "is not from 0.001 to 100", "give a number in that range");
         s.split().setHeatScale(share);
       },
       nullptr, true});
}

}  // namespace lamplighter
