#include "editor/document/document.h"

#include <algorithm>
#include <bit>

#include "renderer/base/hash.h"
#include "renderer/scene/ies/ies_profile.h"
#include "renderer/scene/light_picture.h"

namespace lamplighter {

namespace {

// Hashes the values' bytes in a fixed order; no padding and no pointers go in, so the hash is the
// same on every machine.
class Hasher {
 public:
  void add(uint32_t v) {
    for (int i = 0; i < 4; ++i, v >>= 8) hash_ = hashedWith(hash_, v & 0xff);
  }
  void add(int v) { add(static_cast<uint32_t>(v)); }
  void add(bool v) { add(v ? 1u : 0u); }
  void add(float v) { add(std::bit_cast<uint32_t>(v == 0.0f ? 0.0f : v)); }  // −0 is 0
  void add(const std::string& s) {
    add(static_cast<uint32_t>(s.size()));
    hash_ = hashOfBytes(s, hash_);
  }
  void add(const vec2& v) { add(v.x), add(v.y); }
  void add(const vec3& v) { add(v.x), add(v.y), add(v.z); }
  void add(const vec4& v) { add(v.x), add(v.y), add(v.z), add(v.w); }
  void add(const TextureRef& r) {
    add(r.texture), add(r.texCoord), add(r.offset), add(r.rotation), add(r.scale);
  }
  uint64_t value() const { return hash_; }

 private:
  uint64_t hash_ = kHashStart;
};

// Nothing for the state that lights have at first.
void addLightState(Hasher& h, const LightState& s) {
  if (s == LightState()) return;
  h.add(s.on), h.add(s.solo), h.add(s.group);
  for (const NodeId id : s.leftOut) h.add(id);
}

void addNode(Hasher& h, const Node& n) {
  h.add(n.id), h.add(n.name), h.add(n.parent);
  h.add(n.local.translation), h.add(n.local.scale), h.add(n.local.shear);
  const quat& q = n.local.rotation;
  h.add(vec4(q.x, q.y, q.z, q.w));
  h.add(n.mesh), h.add(n.camera), h.add(n.visible);
  if (n.locked) h.add(n.locked);
  if (n.meshKind != MeshKind::automatic) h.add(static_cast<int>(n.meshKind));
  h.add(n.punctual.has_value());
  if (n.punctual) {
    const PunctualLight& l = *n.punctual;
    h.add(static_cast<int>(l.kind)), h.add(l.intensity), h.add(l.range), h.add(l.innerCone),
        h.add(l.outerCone);
    if (l.profile) h.add(l.profile->file), h.add(l.profile->text);
  }
  h.add(n.area.has_value());
  if (n.area) {
    h.add(static_cast<int>(n.area->shape)), h.add(n.area->radiance), h.add(n.area->size);
    if (const auto& picture = n.area->picture) {
      h.add(picture->file);
      h.add(static_cast<uint32_t>(picture->hash)),
          h.add(static_cast<uint32_t>(picture->hash >> 32));
    }
  }
  addLightState(h, n.light);
}

void addMaterial(Hasher& h, const Material& m) {
  h.add(m.name), h.add(m.baseColor), h.add(m.baseColorTexture), h.add(m.normalTexture),
      h.add(m.normalScale);
  h.add(m.emissive), h.add(m.emissiveTexture), h.add(m.metallic), h.add(m.roughness),
      h.add(m.metallicRoughnessTexture), h.add(m.transmission);
  h.add(static_cast<int>(m.alphaMode)), h.add(m.alphaCutoff), h.add(m.doubleSided);
}

void addSky(Hasher& h, const Sky& sky) {
  h.add(sky.radiance);
  if (sky.kind == SkyKind::constant) return;
  h.add(static_cast<int>(sky.kind)), h.add(sky.zenith), h.add(sky.horizon), h.add(sky.ground);
  h.add(sky.rotation), h.add(sky.scale);
  if (!sky.image) return;
  h.add(static_cast<uint32_t>(sky.image->hash));
  h.add(static_cast<uint32_t>(sky.image->hash >> 32));
}

void addScene(Hasher& h, const Scene& scene) {
  h.add(static_cast<uint32_t>(scene.nodes.size()));
  for (const Node& n : scene.nodes) addNode(h, n);
  h.add(static_cast<uint32_t>(scene.materials.size()));
  for (const Material& m : scene.materials) addMaterial(h, m);
  addSky(h, scene.sky);
  addLightState(h, scene.skyLight);
  for (const LightGroup& g : scene.lightGroups) h.add(g.name), h.add(g.muted), h.add(g.solo);
  for (const CameraBookmark& b : scene.bookmarks) {
    const quat& q = b.orientation;
    h.add(b.slot), h.add(b.eye), h.add(vec4(q.x, q.y, q.z, q.w)), h.add(b.yfov);
  }
}

}  // namespace

bool Document::isSelected(NodeId id) const {
  return std::find(selection.begin(), selection.end(), id) != selection.end();
}

uint64_t sceneHash(const Scene& scene) {
  Hasher h;
  addScene(h, scene);
  return h.value();
}

uint64_t documentHash(const Document& d) {
  Hasher h;
  addScene(h, d.scene);
  h.add(d.render.method), h.add(d.render.exposureEv);
  for (const auto& [name, value] : d.render.values.values()) {
    h.add(name);
    h.add(Settings::format(value));
  }
  return h.value();
}

}  // namespace lamplighter
