// Actions of the split view: two pictures side by side, their difference, and tiles.
#include <map>

#include "editor/actions/arguments.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "renderer/base/error.h"
#include "renderer/image/image_io.h"
#include "renderer/methods/path_tracer/reference_method.h"

namespace lamplighter {
namespace {

bool isOn(const Session& s) { return s.split().on(); }

// Switches the split view on with the live picture and the reference, unless it is on already.
void makeSureOfSplit(Session& s) {
  const std::string& method = s.document().render.method;
  if (!s.split().on())
    s.split().turnOn(readSide("live", method), {readSide(kReferenceMethod, method)});
}

// The live picture and every other method that shows light, or the named sides.
void showTiles(Session& s, std::vector<std::string> names) {
  const std::string& method = s.document().render.method;
  if (names.empty()) {
    names = methodsOfLight();
    std::erase(names, method);
    names.insert(names.begin(), "live");
  }
  std::vector<SplitSide> sides;
  for (const std::string& name : names) sides.push_back(readSide(name, method));
  SplitSide first = std::move(sides.front());
  sides.erase(sides.begin());
  if (sides.empty())
    throw InputError(first.text, "is alone", "give two sides or more, or none for all methods");
  s.split().turnOn(std::move(first), std::move(sides));
  s.split().setShown(SplitView::Shown::tiles);
}

void addTileActions(ActionRegistry& r) {
  r.add({"split.tiles", "All methods as tiles", "[SIDE]…",
         "Shows pictures of the view as tiles with the work and the error of each: all methods, or "
         "the named ones (live many_lights,vpls=1000 reference). In each frame the live picture "
         "and one other are rendered. Each keeps a copy of the level.",
         "", [](Session& s, const Arguments& a) { showTiles(s, a); }, nullptr, true,
         [](const Session& s) { return s.split().showsTiles(); }});
  r.add({"split.export", "Export the comparison", "FILE",
         "Writes all pictures of the split view as one PNG file, with the measurements of each "
         "below it.",
         "",
         [](Session& s, const Arguments& a) {
           const std::filesystem::path file = s.writablePath(a[0]);
           if (!hasExtension(file, kPngExtensions))
             throw InputError(a[0], "is not a .png file", "give a name that ends with .png");
           writePng(s.sheet(), file);
           s.setStatus("Wrote " + file.string());
         },
         isOn, true})
      .asks = {.kind = ActionAsk::Kind::saveFile,
               .title = "Export the comparison",
               .extensions = kPngExtensions,
               .suggested = [](const Session&) { return "comparison.png"; }};
}

}  // namespace

void addSplitActions(ActionRegistry& r) {
  addTileActions(r);
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
           s.split().turnOn(std::move(first), {std::move(second)});
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
  r.add({"split.show", "Compare", "off|both|first|second|heat|tiles",
         "Sets what the split view shows: the live picture, two sides with a divider, one side, "
         "their difference, or all sides as tiles.",
         "",
         [](Session& s, const Arguments& a) {
           using Shown = SplitView::Shown;
           static const std::map<std::string, Shown> kShown = {{"both", Shown::both},
                                                               {"first", Shown::first},
                                                               {"second", Shown::second},
                                                               {"heat", Shown::heat},
                                                               {"tiles", Shown::tiles}};
           if (a[0] == "off") return s.split().turnOff();
           const auto shown = kShown.find(a[0]);
           if (shown == kShown.end())
             throw InputError(a[0], "is not a mode of the split view",
                              "give off, both, first, second, heat or tiles");
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
