#include "tests/tools/imperfect_shadow_maps/moving.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>

#include <spdlog/fmt/fmt.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/base/error.h"
#include "renderer/frame/frame.h"
#include "renderer/image/image_io.h"
#include "renderer/registry/registry.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/transform.h"

namespace lamplighter {
namespace {

constexpr int kFrames = 12;
constexpr float kStep = 0.02f;  // [m]

double secondsNow() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

bool isLamp(const Node& node) { return node.area || node.punctual; }

// Each as NAME=VALUE of a parameter of the method.
Settings settingsOf(const std::string& method, const std::vector<std::string>& set) {
  Settings out;
  for (const std::string& text : set) {
    const size_t at = text.find('=');
    const ParameterSpec* spec = findParameter(findMethod(method).parameters, text.substr(0, at));
    if (at == std::string::npos || spec == nullptr)
      throw InputError("--set " + text, "is no parameter of " + method, "give NAME=VALUE");
    out.set(spec->name, Settings::parse(*spec, text.substr(at + 1)));
  }
  return out;
}

}  // namespace

void printMoving(const std::filesystem::path& file, const std::string& camera,
                 const std::string& method, const std::vector<std::string>& set,
                 const std::filesystem::path& picture) {
  const Settings settings = settingsOf(method, set);
  Scene scene = loadGltf(file).scene;
  View view = viewOfBounds(Bounds{vec3(-1.0f), vec3(1.0f)}, 640, 360);
  for (const Node& node : scene.nodes) {
    if (node.camera < 0 || (!camera.empty() && node.name != camera)) continue;
    view = viewOfCamera(scene, node, 640, 360);
    break;
  }
  // The lamp and the object that are nearest to the eye.
  NodeId lamp = kNoNode, object = kNoNode;
  float lampAway = 1e30f, objectAway = 1e30f;
  for (const Node& node : scene.nodes) {
    const float away =
        glm::length(vec3(worldMatrix(scene, node.id)[3]) - view.eye - 3.0f * view.forward());
    if (isLamp(node) && away < lampAway) lampAway = away, lamp = node.id;
    if (node.mesh >= 0 && !isLamp(node) && away < objectAway) objectAway = away, object = node.id;
  }
  FrameRenderer renderer(makeCpuBackend(), secondsNow, StageTimes::exact);
  SceneChanges changes = SceneChanges::all();
  std::map<std::string, double> stages;
  double total = 0.0;
  GiOutput out;
  for (int frame = 0; frame < kFrames; ++frame) {
    const double start = secondsNow();
    out = renderer.render({scene, changes, view, method, settings});
    const double seconds = secondsNow() - start;
    if (frame > 0) {
      total += seconds;
      for (const StageTime& stage : out.stats.stageSeconds)
        stages[std::string(stage.stage.name)] += stage.seconds;
    }
    const Scene before = scene;
    if (lamp != kNoNode) scene.find(lamp)->local.translation.x += kStep;
    if (object != kNoNode) scene.find(object)->local.translation.z += kStep;
    view.eye += kStep * view.right();
    changes = compare(before, scene);
  }
  std::cout << fmt::format("\n{}, {}: {:.0f} ms per frame", file.stem().string(), method,
                           1e3 * total / (kFrames - 1));
  for (const auto& [name, seconds] : stages)
    if (seconds > 5e-4 * (kFrames - 1))
      std::cout << fmt::format(", {} {:.1f}", name, 1e3 * seconds / (kFrames - 1));
  std::cout << std::endl;
  if (!picture.empty()) writeExr(out.radiance->pixels(), picture);
}

}  // namespace lamplighter
