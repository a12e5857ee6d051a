// The scene as the user edits it: plain data, no pointers into anything else, cheap to copy (meshes
// and pixels are shared and never change). Everything is referred to by index; nodes also by a
// stable id. Units: metres, radians, scene-referred linear Rec.709 radiance.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/base/math.h"
#include "renderer/image/image.h"
#include "renderer/scene/camera_bookmark.h"
#include "renderer/scene/light_state.h"
#include "renderer/scene/node_id.h"
#include "renderer/scene/sky.h"
#include "renderer/scene/transform.h"

namespace lamplighter {

struct IesProfile;    // ies_profile.h
struct LightPicture;  // light_picture.h

inline constexpr int kNone = -1;

struct TextureRef {
  int texture = kNone;  // index into Scene::textures
  int texCoord = 0;     // 0 or 1
  // KHR_texture_transform
  vec2 offset{0.0f};
  float rotation = 0.0f;
  vec2 scale{1.0f};

  bool operator==(const TextureRef&) const = default;
};

enum class Wrap : uint8_t { repeat, clamp, mirror };

struct Texture {
  std::string name;
  std::shared_ptr<const Image8> image;  // never null: a placeholder where decoding failed
  Wrap wrapS = Wrap::repeat;
  Wrap wrapT = Wrap::repeat;
  bool nearest = false;  // magnification filter
  bool placeholder = false;

  bool operator==(const Texture&) const = default;
};

enum class AlphaMode : uint8_t { opaque, mask, blend };

struct Material {
  std::string name;
  vec4 baseColor{1.0f};         // linear; rgb is the Lambertian albedo ρ
  TextureRef baseColorTexture;  // sRGB-encoded
  TextureRef normalTexture;
  float normalScale = 1.0f;
  vec3 emissive{0.0f};         // emissiveFactor × KHR_materials_emissive_strength [W/(m² sr)]
  TextureRef emissiveTexture;  // sRGB-encoded
  float metallic = 1.0f;       // what bounces is Lambert; these are for the eye (brdf.h)
  float roughness = 1.0f;
  TextureRef metallicRoughnessTexture;  // linear; G multiplies roughness, B metallic
  float transmission = 0.0f;            // KHR_materials_transmission
  AlphaMode alphaMode = AlphaMode::opaque;
  float alphaCutoff = 0.5f;
  bool doubleSided = false;  // emits from both sides; reflection is two-sided always

  bool emits() const { return emissive.r > 0.0f || emissive.g > 0.0f || emissive.b > 0.0f; }
  // Panes that light passes: drawn and hit by nothing, until there is real transmission.
  bool isClear() const { return transmission > 0.5f; }
  bool operator==(const Material&) const = default;
};

// Triangles with one material. Attributes are per vertex; empty where the file has none.
struct Primitive {
  std::vector<vec3> positions;
  std::vector<vec3> normals;   // unit, never empty: computed flat where the file has none
  std::vector<vec4> tangents;  // xyz unit, w = handedness ±1
  std::vector<vec2> uv0, uv1;
  std::vector<vec4> colors;       // linear, multiplies the base colour
  std::vector<uint32_t> indices;  // three a triangle, all < positions.size()
  int material = kNone;           // index into Scene::materials, or kNone: the default material
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
};

struct Camera {
  std::string name;
  float yfov = 0.8f;    // radians, vertical
  float aspect = 0.0f;  // width / height, 0: the viewport's
  float znear = 0.01f;
  float zfar = 0.0f;  // 0: infinite
  bool operator==(const Camera&) const = default;
};

enum class PunctualKind : uint8_t { point, spot, directional };

// KHR_lights_punctual: aims down the node's −Z; scale of the node changes nothing.
struct PunctualLight {
  PunctualKind kind = PunctualKind::point;
  vec3 intensity{1.0f};    // color × intensity: W/sr for point and spot, W/m² for directional
  float range = 0.0f;      // metres, 0: infinite
  float innerCone = 0.0f;  // radians, spot
  float outerCone = 0.78539816339f;  // radians, spot
  // Point and spot: how it spreads its light, instead of evenly or by the cones; intensity is that
  // in its brightest direction. Null: none.
  std::shared_ptr<const IesProfile> profile;
  bool operator==(const PunctualLight& other) const;  // profiles by what is in them
};

enum class AreaShape : uint8_t { rectangle, disk, sphere, tube };

// A Lambertian emitter centred on its node, which emits towards the node's −Z (a sphere or tube:
// outwards; a tube lies along X and its ends are open). Size is in the node's space and so takes
// the node's scale. Reflects nothing.
struct AreaLight {
  AreaShape shape = AreaShape::rectangle;
  vec3 radiance{10.0f};  // W/(m² sr)
  // Rectangle: width (X), height (Y); disk and sphere: diameter in x; tube: length (X), diameter.
  vec2 size{1.0f, 1.0f};
  // Rectangle and disk: radiance is times this over the surface, seen upright from the front with
  // the node's Y up; the other shapes shine without. Null: none.
  std::shared_ptr<const LightPicture> picture = nullptr;
  bool operator==(const AreaLight& other) const;  // pictures by what is in them
};

// How a node's mesh is lit. Planar parts are cut into patches with light maps; complex ones, curved
// or of many small triangles, are shaded pixel by pixel.
enum class MeshKind : uint8_t {
  automatic,  // each part as it is
  simple,     // every planar part is a patch, however small
  complex     // all of it
};

struct Node {
  NodeId id = kNoNode;
  std::string name;
  NodeId parent = kNoNode;
  Transform local;
  int mesh = kNone;    // index into Scene::meshes
  int camera = kNone;  // index into Scene::cameras
  std::optional<PunctualLight> punctual;
  std::optional<AreaLight> area;
  bool visible = true;
  bool locked = false;  // not to be picked or moved in the viewport
  LightState light;     // of what it emits, if it emits
  MeshKind meshKind = MeshKind::automatic;
  int sourceNode = kNone;  // index in the file it came from; kNone for one made here

  bool operator==(const Node&) const = default;
};

// What a loader keeps of a file so that saving loses nothing it did not understand. Opaque.
class SceneSource;

struct Scene {
  std::string name;
  std::vector<Node> nodes;  // parents before children
  std::vector<std::shared_ptr<const Mesh>> meshes;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<Camera> cameras;
  NodeId nextId = 1;
  Sky sky;  // around everything
  LightState skyLight;
  std::vector<LightGroup> lightGroups;    // by name, each once
  std::vector<CameraBookmark> bookmarks;  // by slot, each once
  bool skyIsDefault =
      false;  // it was put there because the file has no light; then it is not saved
  std::shared_ptr<const SceneSource> source;

  const Node* find(NodeId id) const;
  Node* find(NodeId id);
};

// The node's transform to world space: the product of its parents' and its own.
mat4 worldMatrix(const Scene& scene, NodeId id);
// All nodes' world matrices, in the order of Scene::nodes. O(nodes).
std::vector<mat4> worldMatrices(const Scene& scene);
// A node is shown when it and all of its parents are visible. In the order of Scene::nodes.
std::vector<bool> visibleNodes(const Scene& scene);

// The radiance of the plain sky that a scene without any light is shown under.
inline constexpr vec3 kDefaultSky{1.0f, 1.0f, 1.0f};
// True when something in the scene emits: an area or punctual light or an emissive material in use.
bool hasLight(const Scene& scene);
// The same of one node, whatever its state is.
bool emitsLight(const Scene& scene, const Node& node);

}  // namespace lamplighter
