// Actions for recovering the work of killed processes, and for the journal of this one.
#include "editor/actions/arguments.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "renderer/base/error.h"

namespace lamplighter {

namespace {

// Starts at 0. Without an argument: the newest.
size_t numberFrom(const Session& s, const Arguments& a) {
  const size_t count = s.crashRecovery().found().size();
  const float n = a.empty() ? 1.0f : numberOf(a[0]);
  if (n >= 1.0f && n <= static_cast<float>(count)) return static_cast<size_t>(n) - 1;
  throw InputError("recovery", "there is no such level to recover",
                   count == 0 ? "nothing is left to recover"
                              : "give a number from 1 to " + std::to_string(count));
}

}  // namespace

void addRecoveryActions(ActionRegistry& r) {
  const auto hasFound = [](const Session& s) { return !s.crashRecovery().found().empty(); };
  r.add(
      {"recovery.recover", "Recover", "[NUMBER]",
       "Opens the autosaved level of a session that did not exit normally. The newest is number 1.",
       "", [](Session& s, const Arguments& a) { s.recoverWork(numberFrom(s, a)); }, hasFound});
  r.add({"recovery.discard", "Discard recoverable work", "[NUMBER]",
         "Deletes the autosaved level of a session that did not exit normally. The newest is "
         "number 1.",
         "", [](Session& s, const Arguments& a) { s.discardWork(numberFrom(s, a)); }, hasFound});
  r.add({"recovery.autosave", "Autosave now", "",
         "Writes the level to a recovery file in the user's state folder. The level's own file "
         "does not change.",
         "", [](Session& s, const Arguments&) { s.autosave(); },
         [](const Session& s) { return s.crashRecovery().isOn(); }});
}

}  // namespace lamplighter
