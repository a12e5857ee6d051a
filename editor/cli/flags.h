// Every flag of the command line, declared for CLI11.
#pragma once

#include <functional>
#include <span>

#include "editor/cli/cli.h"

namespace CLI {
class App;
}

namespace lamplighter::cli {

// What was asked for; the exit code. Empty: the editor.
using Run = std::function<int()>;

// Declares the flags of the program and of those subcommands that are among `words`: no other can
// be asked for, and to declare all takes longer than to run most of them. `manual` knows all.
// `editor` and `run` are set when `app` parses; all of these live until then, `frontend` until
// `run` was called.
void declareFlags(CLI::App& app, std::span<const char* const> words, EditorOptions& editor,
                  Run& run, const Frontend& frontend);

}  // namespace lamplighter::cli
