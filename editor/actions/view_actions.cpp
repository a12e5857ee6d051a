#include <cmath>

#include "editor/actions/arguments.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "renderer/base/error.h"

namespace lamplighter {

void addViewActions(ActionRegistry& r) {
  const auto tool = [&](const char* name, const char* label, const char* help, const char* key,
                        ToolMode mode) {
    r.add({name, label, "", help, key, [mode](Session& s, const Arguments&) { s.setTool(mode); }});
  };
  tool("tool.select", "Select", "Clicks select objects.", "Q", ToolMode::select);
  tool("tool.move", "Move", "Shows handles that move the selection.", "W", ToolMode::move);
  tool("tool.rotate", "Rotate", "Shows handles that rotate the selection.", "E", ToolMode::rotate);
  tool("tool.scale", "Scale", "Shows handles that scale the selection.", "R", ToolMode::scale);
  r.add({"tool.snap", "Snap", "", "Switches snapping on or off. Ctrl inverts it during a drag.",
         "S", [](Session& s, const Arguments&) { s.setSnapping(!s.snapping()); }, nullptr, true});
  r.add({"view.frame_selection", "Frame selection", "",
         "Moves the camera so that the selection is visible, or the whole level if nothing is "
         "selected.",
         "F", [](Session& s, const Arguments&) { s.frameSelection(); }});
  r.add({"view.frame_all", "Frame all", "", "Moves the camera so that the whole level is visible.",
         "Home", [](Session& s, const Arguments&) { s.frameAll(); }});
  for (const DebugViewInfo& info : debugViews()) {
    r.add({std::string("view.") + info.name, info.label, "", info.help, info.key,
           [view = info.view](Session& s, const Arguments&) { s.display().setView(view); }, nullptr,
           true, [view = info.view](const Session& s) { return s.display().view() == view; },
           nullptr, [view = info.view](const Session& s) { return problemOf(view, s.inspect()); }});
  }
  r.add({"view.vpls", "Light samples", "",
         "Marks the position of each light sample. A click on a mark chooses it for the view "
         "Occlusion.",
         "V", [](Session& s, const Arguments&) { s.display().showVpls(!s.display().showsVpls()); },
         nullptr, true, [](const Session& s) { return s.display().showsVpls(); }});
  r.add({"view.probes", "Light probes", "",
         "Shows light probes as balls with the light that falls on them, as lamplighter bake "
         "--probes writes it, and one at the pointer with interpolated light. Costs paths in each "
         "frame until all probes are computed.",
         "", [](Session& s, const Arguments&) { s.probes().setOn(!s.probes().on()); }, nullptr,
         true, [](const Session& s) { return s.probes().on(); }});
  r.add({"view.probe_grid", "Grid of light probes", "SPACING [PADDING]",
         "Sets the distance between light probes, and their minimum distance to surfaces (m). "
         "Smaller distances: more probes, which take longer.",
         "",
         [](Session& s, const Arguments& a) {
           ProbeGridOptions grid = s.probes().options();
           grid.spacing = numberOf(a[0]);
           if (a.size() > 1) grid.padding = numberOf(a[1]);
           if (!(grid.spacing >= 0.01f && grid.spacing <= 1e4f && grid.padding >= 0.0f &&
                 grid.padding <= 1e3f))
             throw InputError("view.probe_grid", "there are no such probes",
                              "give a spacing from 0.01 to 10000 and a padding from 0 to 1000");
           s.probes().setOptions(grid);
         },
         nullptr, true});
  r.add({"view.choose_vpl", "Choose light sample", "INDEX",
         "Chooses the light sample of the view Occlusion, by its index from 0.", "",
         [](Session& s, const Arguments& a) {
           const float index = numberOf(a[0]);
           if (index != std::floor(index) || std::abs(index) > 1e6f)
             throw InputError(a[0], "is not a whole number", "give one such as 12");
           s.display().choose(s.inspect(), static_cast<int>(index));
         },
         nullptr, true});
  r.add({"view.choose_light", "Choose light", "NAME",
         "Chooses the light of the view Occlusion of a light. Selecting a light does the same.", "",
         [](Session& s, const Arguments& a) {
           s.display().chooseLight(nodeNamed(s.document(), a[0]).id);
         },
         nullptr, true});
  r.add({"view.false_colour_unit", "False colour of", "lux|nits",
         "Shows illuminance (lux) or luminance (nits) in the view False colour.", "",
         [](Session& s, const Arguments& a) {
           if (a[0] != "lux" && a[0] != "nits")
             throw InputError(a[0], "is not a unit of light", "give lux or nits");
           FalseColour f = s.display().falseColour();
           f.isLux = a[0] == "lux";
           s.display().setFalseColour(f);
         },
         nullptr, true});
  r.add({"view.false_colour_range", "Automatic range of false colour", "[LOW HIGH]",
         "Sets the values at both ends of the colour scale, in the unit shown. Without numbers, "
         "the range of the picture.",
         "",
         [](Session& s, const Arguments& a) {
           FalseColour f = s.display().falseColour();
           f.low = a.empty() ? 0.0f : numberOf(a[0]);
           f.high = a.empty() ? 0.0f : numberOf(a[1]);
           if (!a.empty() && !(f.low > 0.0f && f.high > f.low))
             throw InputError("view.false_colour_range", a[0] + " to " + a[1] + " is not a range",
                              "give two numbers above 0, the smaller first");
           s.display().setFalseColour(f);
         },
         nullptr, true});
  std::string mappers;
  for (const ToneMapperInfo& m : toneMappers())
    mappers += (mappers.empty() ? "" : "|") + std::string(m.name);
  r.add({"view.tone_mapper", "Tone mapper", mappers,
         "Sets how radiance is mapped to the display. It does not change the lighting, and is not "
         "part of the level.",
         "",
         [](Session& s, const Arguments& a) {
           s.display().setToneMapper(findToneMapper(a[0]).mapper);
         },
         nullptr, true});
  r.add({"view.histogram", "Histogram", "",
         "Shows the luminance histogram of the picture, with exposure and tone mapper.", "N",
         [](Session& s, const Arguments&) {
           s.display().showHistogram(!s.display().showsHistogram());
         },
         nullptr, true, [](const Session& s) { return s.display().showsHistogram(); }});
}

}  // namespace lamplighter
