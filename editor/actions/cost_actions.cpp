// Actions for the cost and the error of the picture: error meter, timeline, presets, memory.
#include <cmath>

#include "editor/actions/arguments.h"
#include "editor/budgets/memory_limit.h"
#include "editor/presets/presets.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "renderer/base/error.h"
#include "renderer/registry/registry.h"

namespace lamplighter {
namespace {

int wholeNumberOf(const std::string& text, int least, int most) {
  const float number = numberOf(text);
  if (number != std::floor(number) || number < static_cast<float>(least) ||
      number > static_cast<float>(most))
    throw InputError(
        text, "is not a whole number from " + std::to_string(least) + " to " + std::to_string(most),
        "give one in that range");
  return static_cast<int>(number);
}

}  // namespace

void addCostActions(ActionRegistry& r) {
  r.add({"error.meter", "Error meter", "",
         "Traces a reference in the background and shows the error of the live picture. It uses "
         "processor time while it is on.",
         "", [](Session& s, const Arguments&) { s.watch().meter.setOn(!s.watch().meter.on()); },
         nullptr, true, [](const Session& s) { return s.watch().meter.on(); }});
  r.add({"error.measure", "Measure the error", "PATHS",
         "Traces this number of paths per block of pixels for each half of the reference, waits "
         "until they are done, and shows the error of the picture.",
         "",
         [](Session& s, const Arguments& a) {
           s.watch().meter.measureAtOnce(wholeNumberOf(a[0], 1, 65536));
         },
         nullptr, true});
  r.add({"error.block", "Compare by blocks", "1|2|4|8",
         "Width in pixels of the blocks that the error meter compares. Larger blocks have less "
         "noise after the same time; smaller blocks show finer errors.",
         "",
         [](Session& s, const Arguments& a) {
           const int block = wholeNumberOf(a[0], 1, 8);
           if ((block & (block - 1)) != 0)
             throw InputError(a[0], "is not a block size", "give 1, 2, 4 or 8");
           s.watch().meter.setBlock(block);
         },
         nullptr, true});
  r.add({"timeline.export", "Export the timeline", "FILE",
         "Writes the timings of the last seconds' frames: a Chrome trace for a name ending in "
         ".json, a table for .csv.",
         "",
         [](Session& s, const Arguments& a) {
           const std::string file = s.writablePath(a[0]).string();
           exportTimeline(s.watch().timeline, file);
           s.setStatus("Wrote " + file);
         },
         nullptr, true})
      .asks = {.kind = ActionAsk::Kind::saveFile,
               .title = "Export the timeline",
               .extensions = kTimelineExtensions,
               .suggested = [](const Session& s) {
                 return (s.document().path.parent_path() / "timeline.json").string();
               }};
  r.add({"timeline.clear", "Clear the timeline", "", "Deletes the recorded frame times.", "",
         [](Session& s, const Arguments&) { s.watch().timeline.clear(); }, nullptr, true});
  r.add({"render.memory", "Memory", "MIB",
         "Sets the sum of all memory limits of the method in MiB. Each limit keeps its proportion. "
         "With less memory, light on surfaces is coarser and shadows are less sharp.",
         "", [](Session& s, const Arguments& a) {
           const MethodInfo& method = findMethod(s.document().render.method);
           const MemoryRange range = memoryRange(method);
           if (range.most == 0)
             throw InputError(method.name, "has no memory limit", "choose another method");
           RenderSettings settings = s.document().render;
           settings.values = withMemoryLimit(method, settings.values,
                                             wholeNumberOf(a[0], range.least, range.most));
           s.setRender(settings);
         }});
  for (const Preset& preset : presets()) {
    r.add({"preset." + preset.name, preset.label, "", preset.help, "",
           [&preset](Session& s, const Arguments&) {
             Transaction edit = s.editing().begin("Preset " + preset.label);
             edit.render() = withPreset(s.document().render, preset);
             edit.commit();
           },
           nullptr, false,
           [&preset](const Session& s) { return hasPreset(s.document().render, preset); }});
  }
}

}  // namespace lamplighter
