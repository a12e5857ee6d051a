#include "editor/cli/cli.h"

#include <iostream>

#include <CLI/CLI.hpp>

#include "editor/cli/flags.h"
#include "editor/notices/failure_text.h"
#include "renderer/base/text.h"

namespace lamplighter {

namespace {

constexpr int kBadUse = 2;

int fail(const std::string& what) {
  std::cerr << "error: " << oneLine(what) << '\n';
  return kBadUse;
}

}  // namespace

int runCommandLine(int argc, const char* const* argv, const Frontend& frontend) {
  CLI::App app("Lamplighter: a lighting editor for level designers", "lamplighter");
  app.set_version_flag("--version", "lamplighter " LAMPLIGHTER_VERSION);
  app.footer(
      "Exit codes: 0 success, 1 a check failed, 2 wrong usage, invalid input or a "
      "failure.\nExample: lamplighter level.glb");
  cli::Run run;
  EditorOptions editor;
  cli::declareFlags(app, {argv, static_cast<size_t>(argc)}, editor, run, frontend);

  try {
    app.parse(argc, argv);
    const int code = run ? run() : frontend.runEditor(editor);
    std::cout.flush();
    if (!std::cout) return fail("standard output: cannot be written; check the space left");
    return code;
  } catch (const CLI::Success& e) {  // --help, --version
    return app.exit(e);
  } catch (const CLI::ParseError& e) {
    std::string help = "lamplighter ";
    for (const CLI::App* sub : app.get_subcommands()) help += sub->get_name() + " ";
    return fail(std::string(e.what()) + "; see '" + help + "--help'");
  } catch (const std::exception& e) {
    return fail(failureText(e));
  }
}

}  // namespace lamplighter
