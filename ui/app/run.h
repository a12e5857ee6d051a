// The entry points of the ui for the command line: the editor in a window, and replays.
#pragma once

#include "editor/cli/cli.h"

namespace lamplighter {

// Both return an exit code, or throw InputError.
int runEditor(const EditorOptions& options, const Frontend& frontend);
int runReplay(const ReplayOptions& options, const Stopwatch& stopwatch);

}  // namespace lamplighter
