#include <algorithm>
#include <iostream>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "editor/cli/subcommands.h"
#include "renderer/sampling/emitters/lights.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter::cli {

namespace {

using Json = nlohmann::ordered_json;

Json toJson(const vec3& v) { return {v.x, v.y, v.z}; }

std::string kindOf(const Node& node, bool emissiveMesh) {
  static constexpr const char* kShapes[] = {"rectangle", "disk", "sphere", "tube"};
  static constexpr const char* kPunctual[] = {"point", "spot", "directional"};
  if (node.area) return kShapes[static_cast<size_t>(node.area->shape)];
  if (node.punctual) return kPunctual[static_cast<size_t>(node.punctual->kind)];
  return emissiveMesh ? "mesh" : "";
}

Json skyJson(const Scene& scene) {
  const Sky& sky = scene.sky;
  if (sky.isBlack()) return {};
  Json j;
  switch (sky.kind) {
    case SkyKind::constant:
      j = {{"kind", "constant"}, {"radiance", toJson(sky.radiance)}};
      break;
    case SkyKind::gradient:
      j = {{"kind", "gradient"},
           {"zenith", toJson(sky.zenith)},
           {"horizon", toJson(sky.horizon)},
           {"ground", toJson(sky.ground)}};
      break;
    case SkyKind::image:
      j = {{"kind", "image"},
           {"file", sky.image->name},
           {"size", {sky.image->pixels.width, sky.image->pixels.height}},
           {"rotation_degrees", glm::degrees(sky.rotation)},
           {"scale", sky.scale},
           {"suns", SkySampler(sky).sunCount()}};
      break;
  }
  j["is_default"] = scene.skyIsDefault;
  return j;
}

// The full output of `info` as JSON. The text form is generated from it.
Json describe(const std::string& file, const LoadedScene& loaded) {
  const Scene& scene = loaded.scene;
  RenderScene world;
  update(world, scene, SceneChanges::all());
  const LightSet lights(world);

  Json j;
  j["scene"] = file;
  j["triangles"] = world.triangleCount();
  j["draws"] =
      std::ranges::count_if(world.objects, [](const RenderObject& o) { return !o.isEmpty(); });
  j["vertices"] = world.positions.size();
  j["nodes"] = scene.nodes.size();
  j["meshes"] = scene.meshes.size();
  j["materials"] = scene.materials.size();
  j["textures"] = scene.textures.size();
  j["bounds"] = {{"min", toJson(world.bounds.min)},
                 {"max", toJson(world.bounds.max)},
                 {"extent", toJson(world.bounds.extent())}};

  j["lights"] = Json::array();
  j["light_counts"] = Json::object();
  for (const Emitter& e : lights.emitters()) {
    if (e.kind == EmitterKind::sky || !(luminance(e.flux) > 0.0f)) continue;
    const Node& node = *scene.find(e.node);
    Json light{{"name", node.name}, {"kind", kindOf(node, true)}, {"flux_w", toJson(e.flux)}};
    if (e.kind == EmitterKind::surface) light["area_m2"] = e.area;
    j["lights"].push_back(light);
    Json& count = j["light_counts"][light["kind"].get<std::string>()];
    count = count.is_null() ? 1 : count.get<int>() + 1;
  }
  j["sky"] = skyJson(scene);

  j["cameras"] = Json::array();
  for (const Node& n : scene.nodes) {
    if (n.camera == kNone) continue;
    const Camera& camera = scene.cameras[n.camera];
    j["cameras"].push_back({{"name", n.name.empty() ? camera.name : n.name},
                            {"yfov_degrees", glm::degrees(camera.yfov)}});
  }
  j["extensions"] = loaded.extensions;
  j["warnings"] = loaded.warnings;
  return j;
}

std::string triple(const Json& v) {
  return fmt::format("{:.4g} {:.4g} {:.4g}", v[0].get<float>(), v[1].get<float>(),
                     v[2].get<float>());
}

std::string skyText(const Json& sky) {
  if (sky["kind"] == "constant") {
    return fmt::format("{} W/(m2 sr), plain{}", triple(sky["radiance"]),
                       sky["is_default"].get<bool>() ? ", not saved" : "");
  }
  if (sky["kind"] == "gradient") {
    return fmt::format("gradient, zenith {}, horizon {}, ground {} W/(m2 sr)",
                       triple(sky["zenith"]), triple(sky["horizon"]), triple(sky["ground"]));
  }
  return fmt::format("'{}', {} x {}, turned by {:g} degrees, times {:g}, suns {}",
                     sky["file"].get<std::string>(), sky["size"][0].get<int>(),
                     sky["size"][1].get<int>(), sky["rotation_degrees"].get<float>(),
                     sky["scale"].get<float>(), sky["suns"].get<int>());
}

void printText(const Json& j) {
  std::cout << fmt::format("{}\n", j["scene"].get<std::string>());
  for (const char* key :
       {"triangles", "draws", "vertices", "nodes", "meshes", "materials", "textures"}) {
    std::cout << fmt::format("  {:<10} {}\n", key, j[key].get<size_t>());
  }
  if (j["triangles"] != 0) {
    std::cout << fmt::format("  extent     {} m, from {} to {}\n", triple(j["bounds"]["extent"]),
                             triple(j["bounds"]["min"]), triple(j["bounds"]["max"]));
  }
  std::cout << fmt::format("  lights     {}\n", j["lights"].size());
  for (const Json& l : j["lights"]) {
    std::cout << fmt::format("    {:<11} '{}', {} W\n", l["kind"].get<std::string>(),
                             l["name"].get<std::string>(), triple(l["flux_w"]));
  }
  if (!j["sky"].is_null()) std::cout << fmt::format("  sky        {}\n", skyText(j["sky"]));
  std::cout << fmt::format("  cameras    {}\n", j["cameras"].size());
  for (const Json& c : j["cameras"]) {
    std::cout << fmt::format("    '{}', {:.1f} degrees\n", c["name"].get<std::string>(),
                             c["yfov_degrees"].get<float>());
  }
  if (!j["extensions"].empty()) {
    std::cout << "  extensions";
    for (const Json& name : j["extensions"]) std::cout << ' ' << name.get<std::string>();
    std::cout << '\n';
  }
}

}  // namespace

int info(const InfoOptions& options) {
  const LoadedScene loaded = loadGltf(options.scene);
  for (const std::string& w : loaded.warnings) std::cerr << "warning: " << w << '\n';
  const Json j = describe(options.scene, loaded);
  if (options.json) {
    // Infinite bounds of an empty scene become null; names with invalid UTF-8 are not an error.
    std::cout << j.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  } else {
    printText(j);
  }
  return 0;
}

}  // namespace lamplighter::cli
