// The scene as the user edits it: plain data without external pointers, cheap to copy (meshes and
// pixels are shared and immutable). Everything is referred to by index; nodes also by a stable id.
// Units: metres, radians, scene-referred linear Rec.709 radiance.
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
  std::shared_ptr<const Image8> image;  // never null: a placeholder if decoding failed
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
  float metallic = 1.0f;       // reflected indirect light is Lambertian; these only affect directly
                               // visible surfaces (brdf.h)
  float roughness = 1.0f;
  TextureRef metallicRoughnessTexture;  // linear; G multiplies roughness, B metallic
  float transmission = 0.0f;            // KHR_materials_transmission
  AlphaMode alphaMode = AlphaMode::opaque;
  float alphaCutoff = 0.5f;
  bool doubleSided = false;  // emits from both sides; both sides always reflect

  bool emits() const { return emissive.r > 0.0f || emissive.g > 0.0f || emissive.b > 0.0f; }
  // Transparent panes: not drawn and not hit by rays, because transmission is not implemented.
  bool isClear() const { return transmission > 0.5f; }
  bool operator==(const Material&) const = default;
};

// Triangles with one material. Attributes are per vertex; empty if the file has none.
struct Primitive {
  std::vector<vec3> positions;
  std::vector<vec3> normals;   // unit, never empty: flat normals if the file has none
  std::vector<vec4> tangents;  // xyz unit, w = handedness ±1
  std::vector<vec2> uv0, uv1;
  std::vector<vec4> colors;       // linear, multiplies the base colour
  std::vector<uint32_t> indices;  // three per triangle, all < positions.size()
  int material = kNone;           // index into Scene::materials, or kNone: the default material
};

struct Mesh {
  std::string name;
  std::vector<Primitive> primitives;
};

struct Camera {
  std::string name;
  float yfov = 0.8f;    // radians, vertical
  float aspect = 0.0f;  // width / height; 0: that of the viewport
  float znear = 0.01f;
  float zfar = 0.0f;  // 0: infinite
  bool operator==(const Camera&) const = default;
};

enum class PunctualKind : uint8_t { point, spot, directional };

// KHR_lights_punctual: aims along −Z of the node; the scale of the node has no effect.
struct PunctualLight {
  PunctualKind kind = PunctualKind::point;
  vec3 intensity{1.0f};    // color × intensity: W/sr for point and spot, W/m² for directional
  float range = 0.0f;      // metres, 0: infinite
  float innerCone = 0.0f;  // radians, spot
  float outerCone = 0.78539816339f;  // radians, spot
  // Point and spot: measured angular distribution that replaces the uniform one or the cones.
  // `intensity` is then the value in the brightest direction. Null: none.
  std::shared_ptr<const IesProfile> profile;
  bool operator==(const PunctualLight& other) const;  // compares the content of profiles
};

enum class AreaShape : uint8_t { rectangle, disk, sphere, tube };

// A Lambertian emitter centred on its node. It emits towards −Z of the node (sphere and tube:
// outwards; a tube lies along X and has open ends). The size is in the space of the node, so the
// scale of the node applies. Reflects nothing.
struct AreaLight {
  AreaShape shape = AreaShape::rectangle;
  vec3 radiance{10.0f};  // W/(m² sr)
  // Rectangle: width (X), height (Y); disk and sphere: diameter in x; tube: length (X), diameter.
  vec2 size{1.0f, 1.0f};
  // Rectangle and disk: multiplies the radiance, seen upright from the front with the node's Y up.
  // Other shapes ignore it. Null: none.
  std::shared_ptr<const LightPicture> picture = nullptr;
  bool operator==(const AreaLight& other) const;  // compares the content of pictures
};

// How a node's mesh is lit. Planar parts are divided into patches with light maps. Complex parts
// (curved, or many small triangles) are shaded per pixel.
enum class MeshKind : uint8_t {
  automatic,  // decided per part
  simple,     // every planar part is divided into patches, however small
  complex     // the whole mesh is complex
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
  bool locked = false;  // cannot be picked or moved in the viewport
  LightState light;     // state of the light that it emits, if any
  MeshKind meshKind = MeshKind::automatic;
  int sourceNode = kNone;  // index in the source file; kNone for a node created here

  bool operator==(const Node&) const = default;
};

// Data of the source file, so that saving preserves members that the loader does not know. Opaque.
class SceneSource;

struct Scene {
  std::string name;
  std::vector<Node> nodes;  // parents precede children
  std::vector<std::shared_ptr<const Mesh>> meshes;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<Camera> cameras;
  NodeId nextId = 1;
  Sky sky;  // around everything
  LightState skyLight;
  std::vector<LightGroup> lightGroups;    // sorted by name, unique
  std::vector<CameraBookmark> bookmarks;  // sorted by slot, unique
  bool skyIsDefault = false;              // the file has no light, so this sky was added; not saved
  std::shared_ptr<const SceneSource> source;

  const Node* find(NodeId id) const;
  Node* find(NodeId id);
};

// World matrix of the node: the product of its parents' transforms and its own.
mat4 worldMatrix(const Scene& scene, NodeId id);
// World matrices of all nodes, in the order of Scene::nodes. O(nodes).
std::vector<mat4> worldMatrices(const Scene& scene);
// In the order of Scene::nodes: whether the node and all of its parents are visible.
std::vector<bool> visibleNodes(const Scene& scene);

// Radiance of the constant sky of a scene without any light.
inline constexpr vec3 kDefaultSky{1.0f, 1.0f, 1.0f};
// Whether something in the scene emits: an area light, a punctual light or an emissive material in
// use.
bool hasLight(const Scene& scene);
// The same for one node, independent of its LightState.
bool emitsLight(const Scene& scene, const Node& node);

}  // namespace lamplighter
