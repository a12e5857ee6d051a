#include "editor/cli/options.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iostream>

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include "renderer/base/error.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter::cli {

namespace {

bool has(const MethodInfo& method, const std::string& name) {
  return findParameter(method.parameters, name) != nullptr;
}

}  // namespace

void applyFlags(Settings& settings, const MethodFlags& o, const MethodInfo& method) {
  struct Shortcut {
    const char* flag;
    const std::string& value;
    std::vector<std::string> names;  // the first of them that the method has is used
  };
  for (const Shortcut& s :
       {Shortcut{"--vpls", o.vpls, {"vpls"}},
        Shortcut{"--direct-share", o.directShare, {"direct_share"}},
        Shortcut{"--bounces", o.bounces, {"bounces"}}, Shortcut{"--seed", o.seed, {"seed"}},
        Shortcut{"--spp", o.spp, {"samples_per_pixel", "antialias"}}}) {
    if (s.value.empty()) continue;
    bool used = false;
    for (const std::string& name : s.names) {
      if (used || !has(method, name)) continue;
      setParameter(settings, method, name, s.value);
      used = true;
    }
    if (!used)
      std::cerr << fmt::format("warning: {} has no effect with {}; it is ignored\n", s.flag,
                               method.name);
  }
  for (const std::string& a : o.assignments) setFromAssignment(settings, method, a);
}

Settings settingsOf(const MethodFlags& flags, const MethodInfo& method) {
  Settings settings;
  // Nobody sees the frames in between, so each frame does all updates. The settled picture is the
  // same.
  if (has(method, "updates")) settings.set("updates", kAllAtOnce);
  // Refinement and repair of a settled picture take time, so they are off unless they are
  // requested.
  for (const char* name : {"refine", "repair"})
    if (has(method, name)) settings.set(name, 0);
  if (has(method, "samples_per_frame")) settings.set("samples_per_frame", 16);
  applyFlags(settings, flags, method);
  return settings;
}

std::pair<int, int> parseSize(const std::string& text) {
  constexpr int kLargest = 16384;
  int width = 0, height = 0;
  const char* end = text.data() + text.size();
  const auto [x, widthError] = std::from_chars(text.data(), end, width);
  if (widthError == std::errc() && x != end && *x == 'x') {
    const auto [rest, heightError] = std::from_chars(x + 1, end, height);
    const bool fits = width >= 1 && height >= 1 && width <= kLargest && height <= kLargest;
    if (heightError == std::errc() && rest == end && fits) return {width, height};
  }
  throw InputError("--size", "'" + text + "' is not a size",
                   "give WIDTHxHEIGHT, each from 1 to 16384, such as 1280x720");
}

void setParameter(Settings& settings, const MethodInfo& method, const std::string& name,
                  const std::string& text) {
  const ParameterSpec* spec = findParameter(method.parameters, name);
  if (!spec) {
    std::string names;
    for (const ParameterSpec& p : method.parameters) names += (names.empty() ? "" : ", ") + p.name;
    throw InputError(method.name, "has no parameter '" + name + "'", "it has: " + names);
  }
  settings.set(name, Settings::parse(*spec, text));
}

void setFromAssignment(Settings& settings, const MethodInfo& method,
                       const std::string& assignment) {
  const size_t equals = assignment.find('=');
  if (equals == std::string::npos) {
    throw InputError("--set", "'" + assignment + "' is not an assignment", "give name=value");
  }
  setParameter(settings, method, assignment.substr(0, equals), assignment.substr(equals + 1));
}

View chooseView(const Scene& scene, const std::string& camera, int width, int height) {
  std::vector<const Node*> cameras;
  for (const Node& n : scene.nodes) {
    if (n.camera != kNone) cameras.push_back(&n);
  }
  if (camera.empty()) {
    if (!cameras.empty()) return viewOfCamera(scene, *cameras.front(), width, height);
    RenderScene world;
    update(world, scene, SceneChanges::all());
    return viewOfBounds(world.bounds, width, height);
  }
  for (const Node* n : cameras) {
    if (n->name == camera || scene.cameras[n->camera].name == camera)
      return viewOfCamera(scene, *n, width, height);
  }
  size_t index = 0;
  const auto [end, error] = std::from_chars(camera.data(), camera.data() + camera.size(), index);
  if (error == std::errc() && end == camera.data() + camera.size() && index < cameras.size()) {
    return viewOfCamera(scene, *cameras[index], width, height);
  }
  std::string names;
  for (const Node* n : cameras) names += (names.empty() ? "'" : ", '") + n->name + "'";
  throw InputError("--camera", "the scene has no camera '" + camera + "'",
                   cameras.empty() ? "it has none; omit the flag to see the whole scene"
                                   : "give one of " + names + " or a number from 0 to " +
                                         std::to_string(cameras.size() - 1));
}

void requireWritable(const std::filesystem::path& file, const std::vector<std::string>& endings) {
  namespace fs = std::filesystem;
  if (!endings.empty() &&
      std::find(endings.begin(), endings.end(), file.extension().string()) == endings.end()) {
    std::string names;
    for (const std::string& e : endings) names += (names.empty() ? "" : " or ") + e;
    throw InputError(file.string(), "has an unknown extension",
                     "name a file that ends in " + names);
  }
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) {
    throw InputError(file.string(), "its folder does not exist",
                     "create the folder first or name another");
  }
  // Only creating a file tests everything: permissions, read-only file systems, too long names.
  const fs::path probe =
      folder / ("." + file.filename().string() + "." + std::to_string(::getpid()) + ".part");
  const bool made = !fs::is_directory(file, ignored) && std::ofstream(probe).is_open();
  fs::remove(probe, ignored);
  if (!made) {
    throw InputError(file.string(), "cannot be written",
                     "name a file in a folder that you may write to");
  }
}

}  // namespace lamplighter::cli
