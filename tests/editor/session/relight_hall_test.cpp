// The hall is relit by a script of actions and by a recording of mouse and keys. Both give the same
// document.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "editor/session/session.h"
#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/folders.h"
#include "tests/support/shared_files.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

const fs::path kTests = test::sourceFolder() / "tests";

// The header of the recording, and the document hash of its last checkpoint.
std::pair<nlohmann::json, std::string> recorded() {
  std::ifstream in(kTests / "recordings/relight_modern_hall.jsonl");
  std::string line, hash;
  std::getline(in, line);
  const nlohmann::json header = nlohmann::json::parse(line);
  while (std::getline(in, line)) {
    const nlohmann::json event = nlohmann::json::parse(line);
    if (event.contains("check")) hash = event["document"];
  }
  return {header, hash};
}

TEST(RelightHall, TheScriptAndTheRecordingMakeTheSameDocument) {
  const fs::path file = test::sharedScenes() / "modern-hall/modern-hall.glb";
  if (!fs::exists(file)) GTEST_SKIP() << "no " << file;
  const auto [header, hash] = recorded();
  Session session(std::make_unique<FrameRenderer>(makeCpuBackend()));
  session.resizeViewport(160, 100);
  session.open(loadGltf(file).scene, file, {});
  RenderSettings render = session.document().render;
  for (const auto& [name, value] : header["settings"].items())
    if (value.is_string())
      render.values.set(name, value.get<std::string>());
    else
      render.values.set(name, value.get<int>());
  session.editing().setInitialRender(std::move(render));
  session.renderFrame();

  std::ifstream script(kTests / "scripts/relight_modern_hall.txt");
  int lines = 0;
  for (std::string line; std::getline(script, line);) {
    if (line.empty() || line[0] == '#') continue;
    ASSERT_TRUE(session.runAction(line)) << line << ": " << session.status();
    ++lines;
  }
  EXPECT_GT(lines, 20);
  char text[17];
  std::snprintf(text, sizeof text, "%016llx",
                static_cast<unsigned long long>(documentHash(session.document())));
  EXPECT_EQ(text, hash);
}

}  // namespace
}  // namespace lamplighter
