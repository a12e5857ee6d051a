// Actions of the undo history and its length.
#include <cmath>

#include "editor/actions/arguments.h"
#include "editor/edits/history_budget.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "renderer/base/error.h"

namespace lamplighter {

const ParameterSpec& undoMemory() {
  static const ParameterSpec kSpec = [] {
    ParameterSpec s;
    s.name = "undo_memory";
    s.label = "Undo memory";
    s.unit = "MiB";
    s.help = "Memory for undo steps. When it is full, the oldest steps are deleted.";
    s.defaultValue = 256;
    s.minimum = 1;
    s.maximum = 65536;
    s.logarithmic = true;
    return s;
  }();
  return kSpec;
}

void addHistoryActions(ActionRegistry& r) {
  r.add({"history.go",
         "Go to step",
         "STEP",
         "Undoes or redoes up to a step of the history. 0 is the level as it was opened.",
         "",
         [](Session& s, const Arguments& a) {
           requireArguments(a, 1, 1, "history.go STEP");
           const float step = numberOf(a[0]);
           if (!(step >= 0.0f && step < 1e7f) || step != std::floor(step))
             throw InputError(a[0], "is no step", "give a whole number from 0");
           s.goToStep(static_cast<size_t>(step));
         },
         {}});
  r.add({"history.memory",
         "Undo memory",
         "MIB",
         "Sets the memory limit for undo steps in MiB, by default 256. When it is reached, the "
         "oldest steps are deleted.",
         "",
         [](Session& s, const Arguments& a) {
           requireArguments(a, 1, 1, "history.memory MIB");
           const ParameterValue mebibytes = Settings::parse(undoMemory(), a[0]);
           s.history().setBudget(static_cast<size_t>(std::get<int>(mebibytes)) * kMebibyte);
         },
         {}});
  r.add({"panel.history",
         "History",
         "",
         "Shows the list of undo steps over the view. A click undoes or redoes up to that step.",
         "U",
         [](Session& s, const Arguments&) { s.display().showHistory(!s.display().showsHistory()); },
         {},
         false,
         [](const Session& s) { return s.display().showsHistory(); }});
}

}  // namespace lamplighter
