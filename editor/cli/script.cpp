// Runs a file of actions, one per line, on a level without a window.
#include <fstream>
#include <iostream>

#include <spdlog/fmt/fmt.h>

#include "editor/cli/options.h"
#include "editor/cli/subcommands.h"
#include "editor/notices/failure_text.h"
#include "editor/session/session.h"
#include "renderer/base/error.h"
#include "renderer/base/threads.h"
#include "renderer/image/image_io.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter::cli {
namespace {

struct Line {
  int number;
  std::string text;
};

// Skips empty lines and comments. A comment starts with #, within a line with a space before it.
std::vector<Line> readScript(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw InputError(path, "cannot be read", "name a text file of actions");
  std::vector<Line> lines;
  int number = 0;
  for (std::string text; std::getline(in, text);) {
    ++number;
    bool inQuotes = false;
    for (size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '"' && (i == 0 || text[i - 1] != '\\')) inQuotes = !inQuotes;
      if (text[i] == '#' && !inQuotes && (i == 0 || text[i - 1] == ' ' || text[i - 1] == '\t'))
        text.resize(i);
    }
    const size_t from = text.find_first_not_of(" \t\r");
    if (from == std::string::npos) continue;
    lines.push_back({number, text.substr(from, text.find_last_not_of(" \t\r") - from + 1)});
  }
  return lines;
}

void open(Session& session, const std::string& path) {
  LoadedScene loaded = loadGltf(path);
  session.open(std::move(loaded.scene), path, loaded.warnings);
}

void show(Session& session) {
  session.renderFrame();
  if (!session.renderError().empty()) throw InputError(session.renderError());
}

// Answers the requests of actions, as the window does after their frame.
void answer(Session& session) {
  if (const auto path = session.takeOpenRequest()) {
    open(session, path->string());
    show(session);
  }
  if (const auto path = session.takeScreenshotRequest()) {
    writePng(session.picture(), *path);
    session.setStatus("Wrote " + path->string());
  }
  session.takeShadersRequest();
}

void runLine(Session& session, const std::string& text) {
  session.setStatus("");
  session.perform(text);
  session.editing().commit();
  show(session);
  answer(session);
  if (!session.status().empty()) std::cout << session.status() << '\n';
}

}  // namespace

int script(const ScriptOptions& options, const Frontend& frontend) {
  const ThreadLimit limit(options.threads);
  const std::vector<Line> lines = readScript(options.script);
  const auto [width, height] = parseSize(options.size);
  const auto makeRenderer = [&] {
    return std::make_unique<FrameRenderer>(frontend.makeBackend(options.backend),
                                           frontend.stopwatch);
  };
  Session session(makeRenderer());
  session.setClock(frontend.stopwatch);
  session.split().setRenderer(makeRenderer);
  session.resizeViewport(width, height);
  if (!options.journal.empty())
    session.keepJournal(options.journal, frontend.process, frontend.unixTime);
  if (!options.scene.empty()) open(session, options.scene);
  show(session);
  for (const Line& line : lines) {
    try {
      runLine(session, line.text);
    } catch (const std::exception& e) {
      throw InputError(fmt::format("{}:{}: {}", options.script, line.number, failureText(e)));
    }
    if (session.quitRequested()) break;
  }
  session.crashRecovery().close();
  return 0;
}

}  // namespace lamplighter::cli
