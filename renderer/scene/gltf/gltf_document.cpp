#include "renderer/scene/gltf/gltf_document.h"

#include <algorithm>
#include <span>

#include "renderer/base/error.h"
#include "renderer/base/json_text.h"

namespace lamplighter {

std::string printable(std::string_view text) {
  constexpr size_t kLongest = 120;
  std::string out(text.substr(0, kLongest));
  for (char& c : out) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  }
  if (text.size() > kLongest) out += "...";
  return out;
}

void GltfDocument::fail(const std::string& wrong, const std::string& remedy) const {
  throw InputError(path.string(), wrong, remedy);
}

void GltfDocument::warn(const std::string& text) {
  warnings.push_back(path.string() + ": " + text);
}

bool GltfDocument::usesExtension(const char* name) const {
  const Json* used = member(json, "extensionsUsed");
  return used != nullptr && used->is_array() &&
         std::find(used->begin(), used->end(), Json(name)) != used->end();
}

const Json& listOf(const GltfDocument& document, const char* name) {
  static const Json kEmpty = Json::array();
  const std::string_view path(name);
  const size_t dot = path.find('.');  // EXTENSION.list
  const Json* owner = &document.json;
  if (dot != path.npos) owner = extensionOf(*owner, std::string(path.substr(0, dot)).c_str());
  const Json* list = owner == nullptr ? nullptr : member(*owner, name + (dot + 1));
  if (list == nullptr) return kEmpty;
  if (!list->is_array()) {
    document.fail(std::string("\"") + name + "\" is not an array");
  }
  return *list;
}

const Json* shownScene(const GltfDocument& document) {
  const Json& scenes = listOf(document, "scenes");
  return scenes.empty() ? nullptr : &scenes[sizeIn(document.json, "scene")];
}

const Json* member(const Json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto it = object.find(key);
  return it == object.end() ? nullptr : &*it;
}

const Json* extensionOf(const Json& object, const char* name) {
  const Json* extensions = member(object, "extensions");
  const Json* extension = extensions == nullptr ? nullptr : member(*extensions, name);
  return extension != nullptr && extension->is_object() ? extension : nullptr;
}

const Json* noteOf(const Json& object, const char* key) {
  const Json* extras = member(object, "extras");
  const Json* ours = extras == nullptr ? nullptr : member(*extras, kExtrasName);
  return ours == nullptr ? nullptr : member(*ours, key);
}

bool isMarked(const Json& object, const char* key) {
  const Json* mark = noteOf(object, key);
  return mark != nullptr && mark->is_boolean() && mark->get<bool>();
}

namespace {

template <typename T>
T valueIn(const Json& object, const char* key, T otherwise) {
  const Json* value = member(object, key);
  return value == nullptr ? otherwise : value->get<T>();
}

}  // namespace

double numberIn(const Json& object, const char* key, double otherwise) {
  return valueIn(object, key, otherwise);
}
bool flagIn(const Json& object, const char* key, bool otherwise) {
  return valueIn(object, key, otherwise);
}
std::string textIn(const Json& object, const char* key) {
  return valueIn(object, key, std::string());
}
size_t sizeIn(const Json& object, const char* key, size_t otherwise) {
  return valueIn(object, key, otherwise);
}
std::vector<double> numbersIn(const Json& object, const char* key) {
  return valueIn(object, key, std::vector<double>());
}

namespace {

constexpr uint32_t kGlbMagic = 0x46546c67;   // "glTF"
constexpr uint32_t kJsonChunk = 0x4e4f534a;  // "JSON"
constexpr uint32_t kBinChunk = 0x004e4942;   // "BIN\0"

uint32_t littleEndian32(const uint8_t* p) {
  return p[0] | uint32_t{p[1]} << 8 | uint32_t{p[2]} << 16 | uint32_t{p[3]} << 24;
}

// Where the chunks of a .glb are in it.
struct Glb {
  std::string_view json;
  std::optional<std::span<const uint8_t>> binary;
};

Glb chunksOf(const GltfDocument& document, const std::vector<uint8_t>& bytes) {
  const char* remedy = "copy or export it again";
  if (bytes.size() < 12) document.fail("is cut off within the header", remedy);
  if (const uint32_t version = littleEndian32(&bytes[4]); version != 2) {
    document.fail("is a binary glTF of version " + std::to_string(version) + ", not 2",
                  "export it as glTF 2.0");
  }
  const size_t stated = littleEndian32(&bytes[8]);
  if (stated != bytes.size()) {
    document.fail("has " + std::to_string(bytes.size()) + " bytes where its header says " +
                      std::to_string(stated),
                  remedy);
  }
  Glb glb;
  size_t at = 12;
  for (size_t chunk = 0; at < bytes.size(); ++chunk) {
    if (bytes.size() - at < 8) document.fail("is cut off within the head of a chunk", remedy);
    const size_t length = littleEndian32(&bytes[at]);
    const uint32_t type = littleEndian32(&bytes[at + 4]);
    at += 8;
    if (length > bytes.size() - at) document.fail("has a chunk that ends past the file", remedy);
    if (chunk == 0 && type != kJsonChunk) document.fail("does not begin with its JSON", remedy);
    if (chunk == 0) glb.json = {reinterpret_cast<const char*>(&bytes[at]), length};
    if (chunk == 1 && type == kBinChunk) glb.binary = std::span(bytes).subspan(at, length);
    // Chunks are padded to four bytes; a last one that is not is harmless.
    at = std::min(bytes.size(), at + (length + 3) / 4 * 4);
  }
  return glb;
}

}  // namespace

GltfDocument readGltfJson(const std::filesystem::path& path) {
  GltfDocument document;
  document.path = path;
  std::string why;
  document.files->push_back(stampOf(path));
  const NewBytes bytes = readWholeFile(path, why);
  if (bytes == nullptr) document.fail(why, "name a .gltf or .glb file that can be read");
  if (bytes->empty()) document.fail("is empty", "copy or export it again");
  document.bytesRead = bytes->size();

  std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  Glb glb;
  if (bytes->size() >= 4 && littleEndian32(bytes->data()) == kGlbMagic) {
    glb = chunksOf(document, *bytes);
    text = glb.json;
  } else {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);  // byte order mark
    const size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos || text[first] != '{') {
      document.fail("is not glTF: it begins neither with { nor with the magic number of a .glb",
                    "name a .gltf or .glb file");
    }
  }

  if (nestingDepth(text) > kDeepestJson) {
    document.fail("has JSON that nests deeper than " + std::to_string(kDeepestJson) + " levels");
  }
  try {
    document.json = Json::parse(text);
  } catch (const Json::exception& e) {
    // "[json.exception.parse_error.101] parse error at line 1, column 7: …"
    std::string_view reason = e.what();
    if (const size_t end = reason.find("] "); end != std::string_view::npos) {
      reason.remove_prefix(end + 2);
    }
    document.fail("has JSON that cannot be read (" + printable(reason) + ")",
                  "copy or export it again");
  }
  if (!document.json.is_object()) document.fail("has JSON that is not an object");
  if (glb.binary) {
    // In place: a copy would be as long as the file.
    const auto begin = bytes->begin() + (glb.binary->data() - bytes->data());
    bytes->erase(begin + static_cast<std::ptrdiff_t>(glb.binary->size()), bytes->end());
    bytes->erase(bytes->begin(), begin);
    document.binaryChunk = bytes;
  }
  return document;
}

}  // namespace lamplighter
