// The editor in a window, and replays: what the command line hands on to the ui.
#pragma once

#include "editor/cli/cli.h"

namespace lamplighter {

// Both return an exit code, or throw InputError.
int runEditor(const EditorOptions& options, const Frontend& frontend);
int runReplay(const ReplayOptions& options, const Stopwatch& stopwatch);

}  // namespace lamplighter
