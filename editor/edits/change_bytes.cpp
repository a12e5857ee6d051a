// How much memory a change keeps.
#include "editor/edits/document_change.h"
#include "renderer/scene/ies/ies_profile.h"
#include "renderer/scene/light_picture.h"

namespace lamplighter {

namespace {

size_t bytesOf(const Node& n) {
  return sizeof n + n.name.size() + n.light.group.size() + sizeof(NodeId) * n.light.leftOut.size() +
         (n.punctual && n.punctual->profile ? n.punctual->profile->text.size() : 0) +
         (n.area && n.area->picture
              ? n.area->picture->bytes->size() + n.area->picture->image->pixels.size()
              : 0);
}

size_t bytesOf(const std::shared_ptr<const Mesh>& mesh) {
  size_t sum = sizeof *mesh;
  for (const Primitive& p : mesh->primitives) {
    sum += sizeof(vec3) * (p.positions.size() + p.normals.size()) +
           sizeof(vec4) * (p.tangents.size() + p.colors.size()) +
           sizeof(vec2) * (p.uv0.size() + p.uv1.size()) + sizeof(uint32_t) * p.indices.size();
  }
  return sum;
}

size_t bytesOf(const Material& m) { return sizeof m + m.name.size(); }

size_t bytesOf(const Texture& t) { return sizeof t + t.image->pixels.size(); }

size_t bytesOf(const RenderSettings& r) {
  constexpr size_t kEntry = 160;  // approximate size of a map entry
  return sizeof r + kEntry * r.values.values().size();
}

size_t bytesOf(const LightState& s) { return sizeof s + sizeof(NodeId) * s.leftOut.size(); }

template <typename T>
size_t bytesOf(const std::vector<T>& list) {
  return sizeof list + sizeof(T) * list.size();
}

size_t pictureBytes(const std::optional<Sky>& sky) {
  if (!sky || !sky->image) return 0;
  // The map for sampling is about as large as the pixels.
  return 2 * sizeof(vec3) * sky->image->pixels.pixels.size() +
         (sky->image->file ? sky->image->file->size() : 0);
}

template <typename T>
size_t bytesOf(const Change<T>& change) {
  return (change.before ? bytesOf(*change.before) : 0) +
         (change.after ? bytesOf(*change.after) : 0);
}

template <typename K, typename T>
size_t bytesOf(const std::map<K, Change<T>>& changes) {
  size_t sum = 0;
  for (const auto& [key, change] : changes) sum += sizeof key + bytesOf(change);
  return sum;
}

}  // namespace

size_t DocumentChange::bytes() const {
  const bool isSamePicture = sky.before && sky.after && sky.before->image == sky.after->image;
  return sizeof *this + bytesOf(nodes) + bytesOf(order) + bytesOf(meshes) + bytesOf(materials) +
         bytesOf(textures) + bytesOf(skyLight) + bytesOf(lightGroups) + bytesOf(bookmarks) +
         bytesOf(render) + (isSamePicture ? 0 : pictureBytes(sky.before) + pictureBytes(sky.after));
}

}  // namespace lamplighter
