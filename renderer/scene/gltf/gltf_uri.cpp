// Resolves URIs in a glTF file: data in the URI itself, or files in the document's folder. Nothing
// else is read: no other folder, no network.
#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>

#include "renderer/scene/gltf/gltf_document.h"

namespace lamplighter {

namespace fs = std::filesystem;

NewBytes readWholeFile(const fs::path& path, std::string& why) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) {
    why = "does not exist";
    return nullptr;
  }
  // Devices and pipes could be read for ever.
  if (error || status.type() != fs::file_type::regular) {
    why = status.type() == fs::file_type::directory ? "is a folder" : "is not a regular file";
    return nullptr;
  }
  const uintmax_t size = fs::file_size(path, error);
  std::ifstream in(path, std::ios::binary);
  if (error || !in) {
    why = "cannot be opened for reading";
    return nullptr;
  }
  auto bytes = std::make_shared<std::vector<uint8_t>>(size);
  in.read(reinterpret_cast<char*>(bytes->data()), static_cast<std::streamsize>(size));
  if (static_cast<uintmax_t>(in.gcount()) != size) {
    why = "cannot be read to its end";
    return nullptr;
  }
  return bytes;
}

namespace {

int hexDigit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

}  // namespace

std::string percentDecoded(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%' && i + 2 < text.size() && hexDigit(text[i + 1]) >= 0 &&
        hexDigit(text[i + 2]) >= 0) {
      out += static_cast<char>(hexDigit(text[i + 1]) * 16 + hexDigit(text[i + 2]));
      i += 2;
    } else {
      out += text[i];
    }
  }
  return out;
}

namespace {

NewBytes base64Decoded(std::string_view text) {
  static const std::array<int8_t, 256> kValue = [] {
    std::array<int8_t, 256> value;
    value.fill(-1);
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < kDigits.size(); ++i) {
      value[static_cast<uint8_t>(kDigits[i])] = static_cast<int8_t>(i);
    }
    return value;
  }();
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  if (text.size() % 4 == 1) return nullptr;
  auto bytes = std::make_shared<std::vector<uint8_t>>();
  bytes->reserve(text.size() / 4 * 3 + 2);
  uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int value = kValue[static_cast<uint8_t>(c)];
    if (value < 0) return nullptr;
    bits = bits << 6 | static_cast<uint32_t>(value);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes->push_back(static_cast<uint8_t>(bits >> count));
    }
  }
  return bytes;
}

NewBytes dataUri(std::string_view uri, std::string& why) {
  const size_t comma = uri.find(',');
  if (comma == std::string_view::npos) {
    why = "is a data URI without data";
    return nullptr;
  }
  const std::string_view head = uri.substr(0, comma), data = uri.substr(comma + 1);
  if (head.ends_with(";base64")) {
    NewBytes bytes = base64Decoded(data);
    if (bytes == nullptr) why = "is a data URI whose base64 is damaged";
    return bytes;
  }
  const std::string decoded = percentDecoded(data);
  return std::make_shared<std::vector<uint8_t>>(decoded.begin(), decoded.end());
}

bool hasScheme(std::string_view uri) {
  const size_t colon = uri.find(':');
  // One letter would be a drive, which is refused as well.
  return colon != std::string_view::npos && colon > 0 &&
         std::isalpha(static_cast<unsigned char>(uri[0])) != 0 &&
         std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon), [](char c) {
           return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '+' || c == '-' ||
                  c == '.';
         });
}

bool isWithin(const fs::path& folder, const fs::path& path) {
  const auto [end, rest] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  return end == folder.end() || (end->empty() && std::next(end) == folder.end());
}

}  // namespace

NewBytes readUri(const GltfDocument& document, const std::string& uri, std::string& why) {
  if (uri.starts_with("data:")) return dataUri(uri, why);
  if (hasScheme(uri)) {
    why = "is an address outside of the file's folder, which is not read";
    return nullptr;
  }
  if (uri.empty()) {
    why = "is empty";
    return nullptr;
  }
  const fs::path folder = document.path.has_parent_path() ? document.path.parent_path() : ".";
  std::string first;
  // Names with a bare % are not escaped by every exporter.
  for (const std::string& name : {percentDecoded(uri), uri}) {
    if (name.find('\0') != std::string::npos) {
      why = "is not a file name";
      return nullptr;
    }
    const fs::path relative(name);
    std::error_code error;
    const fs::path root = fs::weakly_canonical(folder, error);
    const fs::path target = error ? fs::path() : fs::weakly_canonical(folder / relative, error);
    if (relative.is_absolute() || error || !isWithin(root, target)) {
      why = "leads outside of the file's folder, which is not read";
      return nullptr;
    }
    const FileStamp stamp = stampOf(target);
    if (NewBytes bytes = readWholeFile(target, why)) {
      document.files->push_back(stamp);
      return bytes;
    }
    if (first.empty()) first = why;
  }
  why = first;
  return nullptr;
}

}  // namespace lamplighter
