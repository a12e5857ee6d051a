#include "renderer/base/content_cache.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <system_error>
#include <tuple>
#include <type_traits>

#include <unistd.h>

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

// File layout: little-endian, like all supported machines (x86-64). The result follows.
struct Header {
  char magic[8] = {'L', 'L', 'C', 'A', 'C', 'H', 'E', '\x1a'};
  uint32_t version = 0;
  char extension[4] = {};
  uint64_t key[2] = {};
  uint64_t size = 0;
  uint64_t checksum = 0;
};
static_assert(sizeof(Header) == 48 && std::is_trivially_copyable_v<Header>);
static_assert(std::endian::native == std::endian::little);

uint64_t checksumOf(std::span<const uint8_t> bytes) {
  ContentHash hash;
  hash.addBytes(bytes);
  return hash.key()[0];
}

Header headerOf(const ContentCache::Kind& kind, const ContentKey& key, size_t size) {
  Header header;
  header.version = kind.version;
  std::memcpy(header.extension, kind.extension,
              std::min(std::strlen(kind.extension), sizeof header.extension));
  std::copy(key.begin(), key.end(), header.key);
  header.size = size;
  return header;
}

}  // namespace

fs::path ContentCache::fileOf(const ContentKey& key) const {
  char name[33];
  std::snprintf(name, sizeof name, "%016llx%016llx", static_cast<unsigned long long>(key[0]),
                static_cast<unsigned long long>(key[1]));
  return folder_ / (std::string(name) + '.' + kind_.extension);
}

std::optional<std::vector<uint8_t>> ContentCache::load(const ContentKey& key,
                                                       std::optional<size_t> size) const {
  if (folder_.empty()) return std::nullopt;
  const fs::path file = fileOf(key);
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return std::nullopt;
  const uintmax_t onDisk = fs::file_size(file, error);
  if (error || onDisk < sizeof(Header)) return std::nullopt;
  std::vector<uint8_t> result;
  if (size && onDisk - sizeof(Header) != *size) return std::nullopt;
  std::ifstream in(file, std::ios::binary);
  Header header;
  in.read(reinterpret_cast<char*>(&header), sizeof header);
  Header expected = headerOf(kind_, key, onDisk - sizeof(Header));
  expected.checksum = header.checksum;
  if (!in || std::memcmp(&header, &expected, sizeof header) != 0) return std::nullopt;
  result.resize(header.size);
  in.read(reinterpret_cast<char*>(result.data()), static_cast<std::streamsize>(result.size()));
  if (!in || checksumOf(result) != header.checksum) return std::nullopt;
  return result;
}

bool ContentCache::save(const ContentKey& key, std::span<const uint8_t> result) const {
  if (folder_.empty()) return false;
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) return false;
  std::string temporary = (folder_ / "saving-XXXXXX").string();
  const int descriptor = mkstemp(temporary.data());
  if (descriptor < 0) return false;
  Header header = headerOf(kind_, key, result.size());
  header.checksum = checksumOf(result);
  std::FILE* out = fdopen(descriptor, "wb");
  bool isWritten = out != nullptr;
  if (out == nullptr) {
    close(descriptor);
  } else {
    isWritten = std::fwrite(&header, sizeof header, 1, out) == 1 &&
                std::fwrite(result.data(), 1, result.size(), out) == result.size();
    isWritten = std::fclose(out) == 0 && isWritten;
  }
  if (isWritten) fs::rename(temporary, fileOf(key), error);
  if (isWritten && !error) return true;
  fs::remove(temporary, error);
  return false;
}

void ContentCache::keepWithin(uintmax_t bytes) const {
  struct File {
    fs::file_time_type written;
    fs::path path;
    uintmax_t size;
  };
  std::vector<File> files;
  uintmax_t sum = 0;
  std::error_code error;
  const std::string extension = std::string(".") + kind_.extension;
  for (fs::directory_iterator at(folder_, error), end; !error && at != end; at.increment(error)) {
    std::error_code gone;  // another process may delete files at the same time
    const File file{at->last_write_time(gone), at->path(), at->file_size(gone)};
    if (gone || file.path.extension() != extension) continue;
    sum += file.size;
    files.push_back(file);
  }
  std::sort(files.begin(), files.end(), [](const File& a, const File& b) {
    return std::tie(a.written, a.path) < std::tie(b.written, b.path);
  });
  for (size_t i = 0; i < files.size() && sum > bytes; ++i) {
    fs::remove(files[i].path, error);
    sum -= files[i].size;
  }
}

}  // namespace lamplighter
