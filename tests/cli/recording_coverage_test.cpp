// Every action is run by at least one recording, from a menu, a key, the palette or as text. The
// tests of the recordings write reports of the actions that they ran (tests/CMakeLists.txt). This
// test runs after them, as the test recording-coverage.
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "renderer/debug_views/debug_view.h"
#include "tests/support/folders.h"
#include "tests/support/process.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kRecordings = test::sourceFolder() / "tests/recordings";

std::set<std::string> allActions() {
  std::set<std::string> names;
  for (const json& action : json::parse(test::runLamplighter({"actions", "--json"}).out))
    names.insert(action["name"].get<std::string>());
  // Views that a method draws are tested with the method.
  for (const DebugViewInfo& view : debugViews())
    if (!view.method.empty()) names.erase("view." + view.name);
  return names;
}

// The lines "NAME: reason" of uncovered.txt.
std::map<std::string, std::string> reasonsOfUncovered() {
  std::map<std::string, std::string> out;
  std::ifstream in(kRecordings / "uncovered.txt");
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    const size_t colon = line.find(": ");
    out[line.substr(0, colon)] = colon == std::string::npos ? "" : line.substr(colon + 2);
  }
  return out;
}

TEST(RecordingCoverage, EveryActionIsInARecording) {
  const char* folder = std::getenv("LAMPLIGHTER_RECORDING_REPORTS");
  if (folder == nullptr) GTEST_SKIP() << "run it as the test recording-coverage";
  std::set<std::string> covered;
  for (const auto& entry : fs::directory_iterator(kRecordings)) {
    if (entry.path().extension() != ".jsonl") continue;
    const fs::path report = fs::path(folder) / (entry.path().stem().string() + ".json");
    // Recordings of missing scenes have no report.
    if (!fs::exists(report)) continue;
    std::ifstream in(report);
    const json content = json::parse(in);
    for (const json& name : content["actions"]) covered.insert(name.get<std::string>());
  }
  ASSERT_FALSE(covered.empty()) << "there are no reports in " << folder;
  if (!fs::exists(test::sharedFolder() / "scenes"))
    GTEST_SKIP() << "not all recordings are replayed, because ../shared/scenes is missing";
  const std::set<std::string> actions = allActions();
  const std::map<std::string, std::string> without = reasonsOfUncovered();
  for (const std::string& name : actions)
    EXPECT_TRUE(covered.contains(name) || without.contains(name))
        << name << ": no recording in tests/recordings runs it";
  for (const auto& [name, reason] : without) {
    EXPECT_FALSE(reason.empty()) << name << " is listed in uncovered.txt without a reason";
    EXPECT_TRUE(actions.contains(name))
        << name << " is listed in uncovered.txt, but is not an action";
    EXPECT_FALSE(covered.contains(name))
        << name << " is listed in uncovered.txt, but a recording runs it";
  }
}

}  // namespace
}  // namespace lamplighter
