// Declares every flag of the command line for CLI11.
#pragma once

#include <functional>
#include <span>

#include "editor/cli/cli.h"

namespace CLI {
class App;
}

namespace lamplighter::cli {

// The requested command; returns the exit code. Empty: start the editor.
using Run = std::function<int()>;

// Declares the flags of the program and of the subcommands that occur in `words`. Other subcommands
// cannot be requested, and declaring all of them takes longer than most commands run. `manual` has
// all of them. `app` sets `editor` and `run` when it parses, so both must live until then.
// `frontend` must live until `run` was called.
void declareFlags(CLI::App& app, std::span<const char* const> words, EditorOptions& editor,
                  Run& run, const Frontend& frontend);

}  // namespace lamplighter::cli
