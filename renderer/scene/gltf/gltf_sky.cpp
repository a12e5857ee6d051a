// The sky in the extras of a scene: extras.lamplighter.sky (docs/reference/gltf.md).

#include "renderer/base/error.h"
#include "renderer/scene/gltf/gltf_content.h"

namespace lamplighter {

namespace {

constexpr double kMostTurns = 1e6;

// Reason why a note is not a sky; the loader adds the location.
struct Malformed {
  std::string why;
};

double numberOf(const Json& value, const std::string& name, double least, double most) {
  if (!value.is_number()) throw Malformed{"has a " + name + " that is not a number"};
  const double v = value.get<double>();
  if (!(v >= least && v <= most)) throw Malformed{"has a " + name + " out of range"};
  return v;
}

vec3 radianceOf(const Json& note, const char* key) {
  const Json* value = member(note, key);
  if (value == nullptr || !value->is_array() || value->size() != 3)
    throw Malformed{std::string("has no ") + key + " of three numbers"};
  vec3 out;
  for (int c = 0; c < 3; ++c) {
    out[c] =
        static_cast<float>(numberOf((*value)[static_cast<size_t>(c)], key, 0.0, kMostRadiance));
  }
  return out;
}

float numberOr(const Json& note, const char* key, double otherwise, double least, double most) {
  const Json* value = member(note, key);
  return static_cast<float>(value == nullptr ? otherwise : numberOf(*value, key, least, most));
}

Sky pictureOf(const GltfDocument& document, const Json& note) {
  const Json* uri = member(note, "uri");
  if (uri == nullptr || !uri->is_string()) throw Malformed{"names no picture"};
  const float rotation = numberOr(note, "rotation", 0.0, -kMostTurns, kMostTurns);
  const float scale = numberOr(note, "scale", 1.0, 0.0, kMostRadiance);
  const std::string text = uri->get<std::string>();
  std::string why;
  const Bytes bytes = readUri(document, text, why);
  std::string name = std::filesystem::path(percentDecoded(text)).filename().string();
  if (text.starts_with("data:")) name = "sky";
  const auto image = bytes == nullptr ? nullptr : decodeSkyImage(bytes, name, why);
  if (image == nullptr) throw Malformed{"names \"" + printable(text) + "\", which " + why};
  return Sky::picture(image, rotation, scale);
}

Sky skyOf(const GltfDocument& document, const Json& note) {
  const Json* type = member(note, "type");
  if (type != nullptr && *type == "constant") return radianceOf(note, "radiance");
  if (type != nullptr && *type == "gradient") {
    return Sky::gradient(radianceOf(note, "zenith"), radianceOf(note, "horizon"),
                         radianceOf(note, "ground"));
  }
  if (type != nullptr && *type == "image") return pictureOf(document, note);
  throw Malformed{"is of no known type (constant, gradient, image)"};
}

}  // namespace

std::optional<Sky> readSky(GltfDocument& document) {
  const Json* scene = shownScene(document);
  const Json* note = scene == nullptr ? nullptr : noteOf(*scene, kSkyNote);
  if (note == nullptr) return std::nullopt;
  try {
    return skyOf(document, *note);
  } catch (const Malformed& e) {
    document.warn("the sky of " + At{"scenes", sizeIn(document.json, "scene")}.text() + " " +
                  e.why + "; it is left out");
    return std::nullopt;
  }
}

std::shared_ptr<const SkyImage> readSkyImage(const std::filesystem::path& path) {
  std::string why;
  const Bytes bytes = readWholeFile(path, why);
  auto image = bytes == nullptr ? nullptr : decodeSkyImage(bytes, path.filename().string(), why);
  if (image == nullptr) {
    throw InputError(path.string(), why,
                     "name a picture of the whole sky, such as an EXR or HDR file");
  }
  return image;
}

}  // namespace lamplighter
