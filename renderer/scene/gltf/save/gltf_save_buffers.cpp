// Where the bytes of a saved scene are stored. A .gltf saved beside its source keeps the source's
// buffers and gets one additional buffer for new data. All other files get a single buffer with all
// bytes.
#include <algorithm>
#include <cstring>
#include <set>
#include <string_view>

#include "renderer/base/error.h"
#include "renderer/scene/gltf/save/gltf_output.h"

namespace lamplighter {

namespace fs = std::filesystem;

namespace {

// Marks the buffer that was added to a file with buffers of its own.
constexpr const char* kAdditions = "additions";

void pad(std::vector<uint8_t>& bytes, size_t multiple, uint8_t with) {
  bytes.resize((bytes.size() + multiple - 1) / multiple * multiple, with);
}

void appendWord(std::vector<uint8_t>& bytes, size_t value) {
  for (int shift = 0; shift < 32; shift += 8) bytes.push_back(static_cast<uint8_t>(value >> shift));
}

const char* mimeType(const std::vector<uint8_t>& bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (text.starts_with("\xff\xd8\xff")) return "image/jpeg";
  if (text.starts_with("RIFF")) return "image/webp";
  if (text.starts_with("\xabKTX")) return "image/ktx2";
  if (text.starts_with("DDS ")) return "image/vnd-ms.dds";
  return "image/png";
}

// The buffer URIs of the file at `path`, which is about to be replaced.
std::set<std::string> bufferNames(const fs::path& path) {
  std::set<std::string> names;
  try {
    const GltfDocument document = readGltfJson(path);
    for (const Json& buffer : listOf(document, "buffers")) {
      if (const Json* uri = member(buffer, "uri")) names.insert(uri->get<std::string>());
    }
  } catch (const std::exception&) {
    names.clear();  // not glTF, so it has none
  }
  return names;
}

}  // namespace

std::string percentEncoded(const std::string& name) {
  constexpr std::string_view kHex = "0123456789ABCDEF";
  std::string out;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || std::strchr("-._~", c) != nullptr) {
      out += c;
    } else {
      out += {'%', kHex[byte >> 4], kHex[byte & 15]};
    }
  }
  return out;
}

bool GltfOutput::isSameFolder() const {
  const auto folder = [](const fs::path& file) {
    std::error_code error;
    return fs::weakly_canonical(fs::absolute(file, error).parent_path(), error);
  };
  return besideSource && !source.document.path.empty() &&
         folder(path) == folder(source.document.path);
}

// A file name for the buffer that no other file and no kept buffer uses, because those must not be
// overwritten.
fs::path GltfOutput::freeBufferName() {
  std::set<std::string> own = bufferNames(path);
  if (keepsBuffers_) {
    for (const Json& buffer : json["buffers"]) own.erase(buffer["uri"].get<std::string>());
  }
  for (int i = 0;; ++i) {
    const std::string name =
        path.stem().string() + (i == 0 ? "" : "-" + std::to_string(i)) + ".bin";
    if (own.contains(percentEncoded(name)) || own.contains(name)) return name;
    std::error_code error;
    if (!fs::exists(path.parent_path() / name, error)) return name;
  }
}

void GltfOutput::startBuffers() {
  const std::vector<Bytes>& buffers = source.document.buffers;
  const Json& list = listOf(source.document, "buffers");
  keepsBuffers_ = !isBinary && isSameFolder() && !buffers.empty() &&
                  std::all_of(list.begin(), list.end(),
                              [](const Json& b) { return member(b, "uri") != nullptr; });
  if (keepsBuffers_) {
    bufferIndex_ = buffers.size();
    // If an earlier save of this file added a buffer, it is extended, so that there is only one.
    if (path.filename() == source.document.path.filename() && isMarked(list.back(), kAdditions)) {
      --bufferIndex_;
      buffer_.assign(buffers.back()->begin(),
                     buffers.back()->begin() +
                         static_cast<std::ptrdiff_t>(list.back()["byteLength"].get<size_t>()));
    }
    return;
  }
  bufferIndex_ = 0;
  std::vector<size_t> start;
  for (size_t i = 0; i < buffers.size(); ++i) {
    pad(buffer_, 8, 0);
    start.push_back(buffer_.size());
    const size_t length = list[i]["byteLength"].get<size_t>();
    buffer_.insert(buffer_.end(), buffers[i]->begin(),
                   buffers[i]->begin() + static_cast<std::ptrdiff_t>(length));
  }
  const auto move = [&](Json& view) {
    const size_t from = view["buffer"].get<size_t>();
    view["buffer"] = 0;
    if (start[from] > 0) view["byteOffset"] = view.value("byteOffset", size_t{0}) + start[from];
  };
  if (!json.contains("bufferViews")) return;
  for (Json& view : json["bufferViews"]) {
    move(view);
    const auto extensions = view.find("extensions");
    if (extensions == view.end() || !extensions->is_object()) continue;
    for (auto& [name, extension] : extensions->items()) {
      // EXT_meshopt_compression refers to a buffer of its own.
      if (name.ends_with("meshopt_compression") && extension.contains("buffer")) move(extension);
    }
  }
}

size_t GltfOutput::appendView(std::span<const uint8_t> bytes, int target) {
  pad(buffer_, 8, 0);
  Json view = {
      {"buffer", bufferIndex_}, {"byteOffset", buffer_.size()}, {"byteLength", bytes.size()}};
  if (target != 0) view["target"] = target;
  buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
  return append("bufferViews", std::move(view));
}

void GltfOutput::carryImages() {
  if (!isBinary && isSameFolder()) return;
  const std::vector<Bytes>& files = source.document.imageFiles;
  for (size_t i = 0; i < files.size(); ++i) {
    if (files[i] == nullptr) continue;
    const size_t view = appendView(*files[i]);
    Json& image = json["images"][i];
    if (!image.contains("name")) image["name"] = image["uri"];
    image.erase("uri");
    image["mimeType"] = mimeType(*files[i]);
    image["bufferView"] = view;
  }
}

std::vector<GltfOutput::File> GltfOutput::finish() {
  std::vector<File> files = files_;
  if (!buffer_.empty()) {
    Json entry = {{"byteLength", buffer_.size()}};
    if (keepsBuffers_ && bufferIndex_ < source.document.buffers.size()) {
      json["buffers"][bufferIndex_]["byteLength"] = buffer_.size();
      const std::string uri = json["buffers"][bufferIndex_]["uri"].get<std::string>();
      const fs::path file = path.parent_path() / percentDecoded(uri);
      std::string why;
      const Bytes onDisk = readWholeFile(file, why);
      if (onDisk == nullptr || *onDisk != buffer_) files.push_back({file, buffer_});
    } else {
      if (!isBinary) {
        const fs::path name = freeBufferName();
        entry["uri"] = percentEncoded(name.string());
        files.push_back({path.parent_path() / name, buffer_});
      }
      if (keepsBuffers_) entry["extras"][kExtrasName][kAdditions] = true;
      if (!keepsBuffers_) json["buffers"] = Json::array();
      append("buffers", std::move(entry));
    }
  } else if (!keepsBuffers_) {
    json.erase("buffers");
  }

  File main{path, {}};
  if (!isBinary) {
    const std::string text = json.dump(2) + "\n";
    main.bytes.assign(text.begin(), text.end());
  } else {
    const std::string dumped = json.dump();
    std::vector<uint8_t> text(dumped.begin(), dumped.end());
    pad(text, 4, ' ');
    pad(buffer_, 4, 0);
    const size_t total = 20 + text.size() + (buffer_.empty() ? 0 : 8 + buffer_.size());
    if (total > UINT32_MAX) {
      throw InputError(path.string(), "would exceed the largest size of a .glb, 4 GiB",
                       "save it as .gltf");
    }
    main.bytes.reserve(total);
    appendWord(main.bytes, 0x46546c67);  // "glTF"
    appendWord(main.bytes, 2);
    appendWord(main.bytes, total);
    appendWord(main.bytes, text.size());
    appendWord(main.bytes, 0x4e4f534a);  // "JSON"
    main.bytes.insert(main.bytes.end(), text.begin(), text.end());
    if (!buffer_.empty()) {
      appendWord(main.bytes, buffer_.size());
      appendWord(main.bytes, 0x004e4942);  // "BIN"
      main.bytes.insert(main.bytes.end(), buffer_.begin(), buffer_.end());
    }
  }
  files.push_back(std::move(main));
  return files;
}

}  // namespace lamplighter
