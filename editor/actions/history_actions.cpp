// Actions of the undo history and its length.
#include <cmath>

#include "editor/actions/arguments.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "renderer/base/error.h"
#include "renderer/base/parameters.h"

namespace lamplighter {

void addHistoryActions(ActionRegistry& r) {
  r.add({"history.go", "Go to step", "STEP",
         "Undoes or redoes up to a step of the history. 0 is the opened level, without edits.", "",
         [](Session& s, const Arguments& a) {
           const float step = numberOf(a[0]);
           if (!(step >= 0.0f && step < 1e7f) || step != std::floor(step))
             throw InputError(a[0], "is not a step", "give a whole number from 0");
           s.goToStep(static_cast<size_t>(step));
         }});
  r.add({"history.memory", "Undo memory", "MIB",
         "Sets the memory limit for undo steps in MiB, by default 256. When it is reached, the "
         "oldest steps are deleted.",
         "", [](Session& s, const Arguments& a) {
           const ParameterSpec spec{"undo_memory", "Undo memory", "MiB", "", 256, 1, 65536};
           const ParameterValue mebibytes = Settings::parse(spec, a[0]);
           s.editing().setBudget(static_cast<size_t>(std::get<int>(mebibytes)) << 20);
         }});
  r.add({"panel.history", "History", "",
         "Shows the list of undo steps over the view. A click undoes or redoes up to that step.",
         "U",
         [](Session& s, const Arguments&) { s.display().showHistory(!s.display().showsHistory()); },
         nullptr, false, [](const Session& s) { return s.display().showsHistory(); }});
}

}  // namespace lamplighter
