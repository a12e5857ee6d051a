// Actions as text, one per line, as in scripts, recordings and the palette. Each gives an error in
// the status line or an edit that can be undone.
#include <memory>
#include <sstream>

#include "editor/session/session.h"
#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/base/error.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/fuzz/targets/scratch.h"

using namespace lamplighter;

namespace {

constexpr const char* kLevel = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
  "nodes":[{"name":"floor","mesh":0},{"name":"lamp","extensions":{"KHR_lights_punctual":{"light":0}}}],
  "materials":[{"name":"grey"}],
  "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
  "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,1]}],
  "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"square.bin"}],
  "extensionsUsed":["KHR_lights_punctual"],
  "extensions":{"KHR_lights_punctual":{"lights":[{"type":"point"}]}}})";

constexpr size_t kHistoryBudget = size_t{256} << 20;

// Actions that take long or use files outside of the scratch folder.
bool isLeftOut(const std::string& line) {
  return line.find('/') != std::string::npos || line.find("script.wait") != std::string::npos ||
         line.find("error.measure") != std::string::npos;
}

Session& session() {
  static Session kSession(std::make_unique<FrameRenderer>(makeCpuBackend()));
  return kSession;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const LoadedScene kLoaded = loadGltf(fuzz::scratch().write("level.gltf", kLevel));
  Session& s = session();
  s.resizeViewport(32, 20);
  s.open(kLoaded.scene, "level.gltf", {});
  s.editing().setInitialRender({});
  s.editing().setBudget(kHistoryBudget);
  const uint64_t before = documentHash(s.document());
  std::istringstream lines{std::string(fuzz::textOf(data, size))};
  int count = 0;
  for (std::string line; std::getline(lines, line) && count < 20; ++count)
    if (!isLeftOut(line)) s.runAction(line);
  s.takeOpenRequest();
  s.takeScreenshotRequest();
  s.requestQuit(false);
  // With less memory (history.memory), the first steps may have been dropped.
  if (s.history().first() > 0) return 0;
  s.editing().goTo(0);
  // The automatic exposure is not an edit.
  Document undone = s.document();
  undone.render.exposureEv = 0.0f;
  if (documentHash(undone) != before) fuzz::broken("undoing all steps restores the document");
  return 0;
}
