#include <map>
#include <tuple>

#include "renderer/scene/gltf/gltf_lights.h"
#include "renderer/scene/gltf/save/gltf_output.h"
#include "renderer/scene/light_shapes.h"

namespace lamplighter {

namespace {

using Color = std::tuple<float, float, float>;
using ShapeKey = std::tuple<bool, float, float>;  // whether it is a tube; size

class SphereSaver {
 public:
  explicit SphereSaver(GltfOutput& out) : out_(out) {}

  // The mesh for a sphere or tube; equal lights share it.
  size_t mesh(const AreaLight& light) {
    const Color color{light.radiance.r, light.radiance.g, light.radiance.b};
    const bool isTube = light.shape == AreaShape::tube;
    const ShapeKey shapeKey{isTube, light.size.x, isTube ? light.size.y : light.size.x};
    const auto [it, isNew] = meshes_.try_emplace({color, shapeKey}, 0);
    if (!isNew) return it->second;
    const Primitive shape = tessellate(light);
    const auto [shared, isNewKind] = shared_.try_emplace(isTube);
    if (isNewKind) {
      shared->second.normals =
          marked("accessors", appendFloats(out_, floats(shape.normals), 3, false));
      shared->second.indices =
          marked("accessors", appendIndices(out_, shape.indices, shape.positions.size()));
      markLastViews(2);
    }
    const auto [place, isNewSize] = positions_.try_emplace(shapeKey, 0);
    if (isNewSize) {
      place->second = marked("accessors", appendFloats(out_, floats(shape.positions), 3, true));
      markLastViews(1);
    }
    Json primitive = {
        {"attributes", {{"POSITION", place->second}, {"NORMAL", shared->second.normals}}},
        {"indices", shared->second.indices},
        {"material", material(light.radiance, color)}};
    Json json = {{"name", isTube ? "tube light" : "sphere light"}};
    json["primitives"].push_back(std::move(primitive));
    it->second = marked("meshes", out_.append("meshes", std::move(json)));
    return it->second;
  }

 private:
  static std::span<const float> floats(const std::vector<vec3>& v) {
    return {&v[0][0], 3 * v.size()};
  }

  size_t marked(const char* list, size_t index) {
    out_.json[list][index]["extras"][kExtrasName][kSphereMark] = true;
    return index;
  }
  void markLastViews(size_t count) {
    const size_t size = out_.json["bufferViews"].size();
    for (size_t i = size - count; i < size; ++i) marked("bufferViews", i);
  }

  size_t material(const vec3& radiance, const Color& key) {
    const auto [it, isNew] = materials_.try_emplace(key, 0);
    if (!isNew) return it->second;
    const ScaledColor scaled = scaledColor(radiance);
    Json json = {
        {"name", "sphere light"},
        {"pbrMetallicRoughness",
         {{"baseColorFactor", {0, 0, 0, 1}}, {"metallicFactor", 0}, {"roughnessFactor", 1}}},
        {"emissiveFactor", scaled.color}};
    if (scaled.scale != 1.0) {
      extensionObject(json, "KHR_materials_emissive_strength")["emissiveStrength"] = scaled.scale;
      out_.useExtension("KHR_materials_emissive_strength");
    }
    it->second = marked("materials", out_.append("materials", std::move(json)));
    return it->second;
  }

  GltfOutput& out_;
  struct Shared {
    size_t normals = 0, indices = 0;  // accessors
  };
  std::map<bool, Shared> shared_;         // shared by all spheres, and by all tubes
  std::map<ShapeKey, size_t> positions_;  // accessors
  std::map<Color, size_t> materials_;     // by radiance
  std::map<std::pair<Color, ShapeKey>, size_t> meshes_;
};

}  // namespace

void saveSphereMeshes(GltfOutput& out, const std::vector<size_t>& jsonNodes) {
  SphereSaver saver(out);
  for (size_t i = 0; i < jsonNodes.size(); ++i) {
    const Node& node = out.scene.nodes[i];
    const bool isNoted = node.area && isNotedShape(node.area->shape);
    // A node can have only one mesh. If it has a mesh of its own, that is kept and only the extras
    // store the light.
    if (isNoted && node.mesh == kNone) {
      const size_t mesh = saver.mesh(*node.area);
      out.json["nodes"][jsonNodes[i]]["mesh"] = mesh;
    }
  }
}

}  // namespace lamplighter
