// Camera bookmarks: extras.lamplighter.bookmarks of the default scene (docs/reference/gltf.md).
#include <algorithm>
#include <cmath>

#include "renderer/scene/gltf/gltf_content.h"
#include "renderer/scene/gltf/save/gltf_output.h"

namespace lamplighter {

namespace {

constexpr const char* kNote = "bookmarks";
// Reads `count` numbers within ±most. Returns false if the member is anything else.
bool read(const Json& note, const char* key, size_t count, double most, float* out) {
  const Json* list = member(note, key);
  if (list == nullptr || !list->is_array() || list->size() != count) return false;
  for (size_t i = 0; i < count; ++i) {
    const Json& value = (*list)[i];
    if (!value.is_number() || !(std::abs(value.get<double>()) <= most)) return false;
    out[i] = value.get<float>();
  }
  return true;
}

std::optional<CameraBookmark> bookmarkOf(const Json& note) {
  CameraBookmark b;
  const Json *slot = member(note, "slot"), *yfov = member(note, "yfov");
  vec4 q(0.0f);
  if (slot == nullptr || !slot->is_number_unsigned() || yfov == nullptr || !yfov->is_number() ||
      !read(note, "eye", 3, kFarthestPlace, &b.eye[0]) || !read(note, "rotation", 4, 2.0, &q[0]))
    return std::nullopt;
  const auto number = slot->get<uint64_t>();
  b.yfov = yfov->get<float>();
  if (number < 1 || number > kCameraBookmarks || !(b.yfov > 0.01f && b.yfov < 3.1f) ||
      !(glm::length(q) > 0.1f))
    return std::nullopt;
  b.slot = static_cast<int>(number);
  b.orientation = glm::normalize(quat(q.w, q.x, q.y, q.z));
  return b;
}

}  // namespace

std::vector<CameraBookmark> readBookmarks(GltfDocument& document) {
  std::vector<CameraBookmark> out;
  const Json* scene = shownScene(document);
  const Json* note = scene == nullptr ? nullptr : noteOf(*scene, kNote);
  if (note == nullptr) return out;
  bool isSound = note->is_array() && note->size() <= kCameraBookmarks;
  for (size_t i = 0; isSound && i < note->size(); ++i) {
    const auto bookmark = bookmarkOf((*note)[i]);
    isSound = bookmark && std::none_of(out.begin(), out.end(), [&](const CameraBookmark& b) {
                return b.slot == bookmark->slot;
              });
    if (isSound) out.push_back(*bookmark);
  }
  if (!isSound) document.warn("a camera bookmark is malformed; it and those after it are left out");
  std::sort(out.begin(), out.end(),
            [](const CameraBookmark& a, const CameraBookmark& b) { return a.slot < b.slot; });
  return out;
}

void saveBookmarks(GltfOutput& out) {
  const auto& now = out.scene.bookmarks;
  if (now == out.source.bookmarks) return;
  if (!out.json.contains("scenes")) {
    if (now.empty()) return;
    out.json["scenes"] = Json::array({Json::object()});
    out.json["scene"] = 0;
  }
  Json& scene = out.json["scenes"][out.json.value("scene", size_t{0})];
  eraseNote(scene, kNote);
  if (now.empty()) return;
  Json list = Json::array();
  for (const CameraBookmark& b : now) {
    const quat& q = b.orientation;
    list.push_back({{"slot", b.slot},
                    {"eye", toJson(b.eye)},
                    {"rotation", toJson(vec4(q.x, q.y, q.z, q.w))},
                    {"yfov", toJson(b.yfov)}});
  }
  noteFor(scene)[kNote] = std::move(list);
}

}  // namespace lamplighter
