#include "editor/recovery/value_json.h"

#include <limits>
#include <type_traits>

#include "editor/recovery/mesh_bytes.h"
#include "renderer/base/error.h"
#include "renderer/scene/ies/ies_profile.h"
#include "renderer/scene/light_picture.h"

namespace lamplighter {

namespace {

template <typename T>
inline constexpr bool kIsVector = false;
template <glm::length_t N>
inline constexpr bool kIsVector<glm::vec<N, float>> = true;

struct Writer {
  Json& json;
  Blobs& blobs;

  template <typename T>
  void operator()(const char* key, const T& value) {
    json[key] = put(value);
  }

  template <typename T>
  Json put(const T& v) {
    if constexpr (std::is_enum_v<T>) {
      return static_cast<int>(v);
    } else if constexpr (std::is_arithmetic_v<T> || std::is_same_v<T, std::string>) {
      return v;
    } else if constexpr (std::is_same_v<T, quat>) {
      return {v.x, v.y, v.z, v.w};
    } else if constexpr (kIsVector<T>) {
      Json out = Json::array();
      for (glm::length_t i = 0; i < T::length(); ++i) out.push_back(v[i]);
      return out;
    } else {
      Json out = Json::object();
      Writer inner{out, blobs};
      fields(inner, v);
      return out;
    }
  }
  template <typename T>
  Json put(const std::optional<T>& v) {
    return v ? put(*v) : Json();
  }
  Json put(const std::shared_ptr<const IesProfile>& v) {
    if (!v) return {};
    // As bytes, because files from before Unicode contain arbitrary bytes.
    const std::span bytes(reinterpret_cast<const uint8_t*>(v->text.data()), v->text.size());
    return {{"file", v->file}, {"text", blobs.put(bytes)}};
  }
  Json put(const std::shared_ptr<const LightPicture>& v) {
    if (!v) return {};
    return {{"file", v->file}, {"bytes", blobs.put(*v->bytes)}};
  }
  Json put(const std::vector<NodeId>& v) {
    Json out = Json::array();
    for (const NodeId id : v) out.push_back(id);
    return out;
  }
  Json put(const std::shared_ptr<const SkyImage>& v) {
    if (!v) return {};
    if (!v->file) damagedJournal("the sky's picture has no file");
    return {{"name", v->name}, {"file", blobs.put(*v->file)}};
  }
  Json put(const std::shared_ptr<const Image8>& v) {
    return {{"width", v->width}, {"height", v->height}, {"pixels", blobs.put(v->pixels)}};
  }
  Json put(const std::vector<Primitive>& v) { return blobs.put(bytesOf(v)); }
};

struct Reader {
  const Json& json;
  Blobs& blobs;

  template <typename T>
  void operator()(const char* key, T& value) {
    get(json.at(key), value);
  }

  template <typename T>
  void get(const Json& j, T& v) {
    if constexpr (std::is_enum_v<T>) {
      const int i = wholeOf<int>(j);
      if (i < 0 || i > 16) damagedJournal("an enumeration value is unknown");
      v = static_cast<T>(i);
    } else if constexpr (std::is_floating_point_v<T>) {
      // NaN and infinity are written as null.
      v = j.is_null() ? std::numeric_limits<T>::quiet_NaN() : j.get<T>();
    } else if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
      v = wholeOf<T>(j);
    } else if constexpr (std::is_same_v<T, bool> || std::is_same_v<T, std::string>) {
      v = j.get<T>();
    } else if constexpr (std::is_same_v<T, quat>) {
      get(j.at(0), v.x), get(j.at(1), v.y), get(j.at(2), v.z), get(j.at(3), v.w);
    } else if constexpr (kIsVector<T>) {
      for (glm::length_t i = 0; i < T::length(); ++i) get(j.at(static_cast<size_t>(i)), v[i]);
    } else {
      Reader inner{j, blobs};
      fields(inner, v);
    }
  }
  template <typename T>
  void get(const Json& j, std::optional<T>& v) {
    v.reset();
    if (!j.is_null()) get(j, v.emplace());
  }
  void get(const Json& j, std::shared_ptr<const IesProfile>& v) {
    v.reset();
    if (j.is_null()) return;
    const std::vector<uint8_t> text = blobs.get(j.at("text").get<std::string>());
    v = parseIes({reinterpret_cast<const char*>(text.data()), text.size()},
                 j.at("file").get<std::string>());
  }
  void get(const Json& j, std::shared_ptr<const LightPicture>& v) {
    v.reset();
    if (j.is_null()) return;
    std::string why;
    auto bytes =
        std::make_shared<const std::vector<uint8_t>>(blobs.get(j.at("bytes").get<std::string>()));
    v = decodeLightPicture(bytes, j.at("file").get<std::string>(), why);
    if (!v) damagedJournal("a light's picture " + why);
  }
  void get(const Json& j, std::vector<NodeId>& v) {
    v.clear();
    for (const Json& id : j) v.push_back(wholeOf<NodeId>(id));
  }
  void get(const Json& j, std::shared_ptr<const SkyImage>& v) {
    v.reset();
    if (j.is_null()) return;
    std::string why;
    auto bytes =
        std::make_shared<const std::vector<uint8_t>>(blobs.get(j.at("file").get<std::string>()));
    v = decodeSkyImage(bytes, j.at("name").get<std::string>(), why);
    if (!v) damagedJournal("the sky's picture " + why);
  }
  void get(const Json& j, std::shared_ptr<const Image8>& v) {
    auto image = std::make_shared<Image8>();
    image->width = wholeOf<int>(j.at("width"));
    image->height = wholeOf<int>(j.at("height"));
    image->pixels = blobs.get(j.at("pixels").get<std::string>());
    const bool fits = image->width > 0 && image->height > 0 &&
                      image->pixels.size() == 4ull * static_cast<size_t>(image->width) *
                                                  static_cast<size_t>(image->height);
    if (!fits) damagedJournal("a picture has the wrong size");
    v = std::move(image);
  }
  void get(const Json& j, std::vector<Primitive>& v) {
    v = primitivesOf(blobs.get(j.get<std::string>()));
  }
};

// The members of each type, listed by structured bindings: a new member does not compile until it
// is added here, so the journal cannot miss an edit. `A` writes or reads.

// A value, const to be written.
template <typename T, typename Value>
concept Is = std::same_as<std::remove_const_t<T>, Value>;

template <typename A, Is<Transform> T>
void fields(A& a, T& v) {
  auto& [translation, rotation, scale, shear] = v;
  a("t", translation), a("r", rotation), a("s", scale), a("h", shear);
}

template <typename A, Is<PunctualLight> T>
void fields(A& a, T& v) {
  auto& [kind, intensity, range, innerCone, outerCone, profile] = v;
  a("kind", kind), a("intensity", intensity), a("range", range), a("inner", innerCone);
  a("outer", outerCone), a("profile", profile);
}

template <typename A, Is<AreaLight> T>
void fields(A& a, T& v) {
  auto& [shape, radiance, size, picture] = v;
  a("shape", shape), a("radiance", radiance), a("size", size), a("picture", picture);
}

template <typename A, Is<LightState> T>
void fields(A& a, T& v) {
  auto& [on, solo, group, leftOut] = v;
  a("on", on), a("solo", solo), a("group", group), a("leftOut", leftOut);
}

template <typename A, Is<LightGroup> T>
void fields(A& a, T& v) {
  auto& [name, muted, solo] = v;
  a("name", name), a("muted", muted), a("solo", solo);
}

template <typename A, Is<Node> T>
void fields(A& a, T& v) {
  auto& [id, name, parent, local, mesh, camera, punctual, area, visible, locked, light, meshKind,
         sourceNode] = v;
  a("id", id), a("name", name), a("parent", parent), a("local", local), a("mesh", mesh);
  a("camera", camera), a("punctual", punctual), a("area", area), a("visible", visible),
      a("locked", locked);
  a("light", light), a("meshKind", meshKind), a("sourceNode", sourceNode);
}

template <typename A, Is<TextureRef> T>
void fields(A& a, T& v) {
  auto& [texture, texCoord, offset, rotation, scale] = v;
  a("texture", texture), a("texCoord", texCoord), a("offset", offset), a("rotation", rotation);
  a("scale", scale);
}

template <typename A, Is<Material> T>
void fields(A& a, T& v) {
  auto& [name, baseColor, baseColorTexture, normalTexture, normalScale, emissive, emissiveTexture,
         metallic, roughness, metallicRoughnessTexture, transmission, alphaMode, alphaCutoff,
         doubleSided] = v;
  a("name", name), a("baseColor", baseColor), a("baseColorTexture", baseColorTexture);
  a("normalTexture", normalTexture), a("normalScale", normalScale), a("emissive", emissive);
  a("emissiveTexture", emissiveTexture), a("metallic", metallic), a("roughness", roughness);
  a("metallicRoughnessTexture", metallicRoughnessTexture), a("transmission", transmission);
  a("alphaMode", alphaMode), a("alphaCutoff", alphaCutoff), a("doubleSided", doubleSided);
}

template <typename A, Is<Texture> T>
void fields(A& a, T& v) {
  auto& [name, image, wrapS, wrapT, nearest, placeholder] = v;
  a("name", name), a("image", image), a("wrapS", wrapS), a("wrapT", wrapT);
  a("nearest", nearest), a("placeholder", placeholder);
}

template <typename A, Is<Mesh> T>
void fields(A& a, T& v) {
  auto& [name, primitives] = v;
  a("name", name), a("primitives", primitives);
}

template <typename A, Is<Camera> T>
void fields(A& a, T& v) {
  auto& [name, yfov, aspect, znear, zfar] = v;
  a("name", name), a("yfov", yfov), a("aspect", aspect), a("znear", znear), a("zfar", zfar);
}

template <typename A, Is<Sky> T>
void fields(A& a, T& v) {
  auto& [kind, radiance, zenith, horizon, ground, image, rotation, scale] = v;
  a("kind", kind), a("radiance", radiance), a("zenith", zenith), a("horizon", horizon);
  a("ground", ground), a("image", image), a("rotation", rotation), a("scale", scale);
}

template <typename A, Is<CameraBookmark> T>
void fields(A& a, T& v) {
  auto& [slot, eye, orientation, yfov] = v;
  a("slot", slot), a("eye", eye), a("orientation", orientation), a("yfov", yfov);
}

}  // namespace

void damagedJournal(const std::string& what) {
  throw InputError("journal", what, "it is damaged; use the autosave beside it");
}

template <typename T>
Json toJson(const T& value, Blobs& blobs) {
  Json json;
  return Writer{json, blobs}.put(value);
}

template <typename T>
void fromJson(const Json& json, Blobs& blobs, T& value) {
  Reader{json, blobs}.get(json, value);
}

template Json toJson(const Node&, Blobs&);
template void fromJson(const Json&, Blobs&, Node&);
template Json toJson(const Material&, Blobs&);
template void fromJson(const Json&, Blobs&, Material&);
template Json toJson(const Texture&, Blobs&);
template void fromJson(const Json&, Blobs&, Texture&);
template Json toJson(const Mesh&, Blobs&);
template void fromJson(const Json&, Blobs&, Mesh&);
template Json toJson(const Camera&, Blobs&);
template void fromJson(const Json&, Blobs&, Camera&);
template Json toJson(const Sky&, Blobs&);
template void fromJson(const Json&, Blobs&, Sky&);
template Json toJson(const LightState&, Blobs&);
template void fromJson(const Json&, Blobs&, LightState&);
template Json toJson(const LightGroup&, Blobs&);
template void fromJson(const Json&, Blobs&, LightGroup&);
template Json toJson(const CameraBookmark&, Blobs&);
template void fromJson(const Json&, Blobs&, CameraBookmark&);

// Each value with a letter for its type, because JSON does not distinguish 1 and 1.0.
Json toJson(const RenderSettings& render, Blobs&) {
  Json values = Json::object();
  for (const auto& [name, value] : render.values.values()) {
    values[name] = std::visit(
        [type = std::string(1, "bifs"[value.index()])](const auto& v) -> Json {
          return {type, v};
        },
        value);
  }
  return {{"method", render.method}, {"exposure", render.exposureEv}, {"values", values}};
}

void fromJson(const Json& json, Blobs&, RenderSettings& render) {
  render = {};
  render.method = json.at("method").get<std::string>();
  render.exposureEv = json.at("exposure").get<float>();
  for (const auto& [name, value] : json.at("values").items()) {
    const std::string type = value.at(0).get<std::string>();
    const Json& v = value.at(1);
    if (type == "b")
      render.values.set(name, v.get<bool>());
    else if (type == "i")
      render.values.set(name, wholeOf<int>(v));
    else if (type == "f")
      render.values.set(name, v.get<float>());
    else
      render.values.set(name, v.get<std::string>());
  }
}

}  // namespace lamplighter
