// The command line, one argument per line. The exit code must be 0, 1 or 2.
#include <iostream>
#include <sstream>
#include <vector>

#include "editor/cli/cli.h"
#include "renderer/base/error.h"
#include "tests/fuzz/targets/scratch.h"

using namespace lamplighter;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  fuzz::scratch();
  std::istringstream lines{std::string(fuzz::textOf(data, size))};
  std::vector<std::string> words{"lamplighter"};
  for (std::string line; std::getline(lines, line) && words.size() < 20;) {
    // Only files of the scratch folder are allowed.
    if (line.find('/') == std::string::npos && line.find('\0') == std::string::npos)
      words.push_back(line);
  }
  std::vector<const char*> arguments;
  for (const std::string& w : words) arguments.push_back(w.c_str());
  Frontend frontend;
  frontend.makeBackend = [](const std::string&) -> std::unique_ptr<Backend> {
    throw InputError("no backend here");
  };
  frontend.runEditor = [](const EditorOptions&) { return 0; };
  frontend.runReplay = [](const ReplayOptions&) { return 0; };
  frontend.stopwatch = [] { return 0.0; };
  frontend.unixTime = [] { return int64_t{0}; };
  std::ostringstream out, err;
  auto* const wasOut = std::cout.rdbuf(out.rdbuf());
  auto* const wasErr = std::cerr.rdbuf(err.rdbuf());
  const int code = runCommandLine(static_cast<int>(arguments.size()), arguments.data(), frontend);
  std::cout.rdbuf(wasOut);
  std::cerr.rdbuf(wasErr);
  if (code < 0 || code > 2) fuzz::broken("an exit code of 0, 1 or 2");
  const std::string said = err.str();
  // Errors repeat the input, and the fuzzer may find these words.
  constexpr std::string_view kFault = "bug of the program";
  if (said.find(kFault) != std::string::npos &&
      fuzz::textOf(data, size).find(kFault) == std::string_view::npos)
    fuzz::broken(said);
  if (code == 2 && (!said.starts_with("error: ") && said.find("\nerror: ") == std::string::npos))
    fuzz::broken("errors begin with \"error: \": " + said);
  return 0;
}
