#include "renderer/prt/transfer_cache.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <span>
#include <string>
#include <system_error>
#include <type_traits>

#include <unistd.h>

#include "renderer/base/hash.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

// Increase this when the computation or the file format changes.
constexpr uint32_t kVersion = 2;

// File layout: little-endian, like all supported machines (x86-64).
struct Header {
  char magic[8] = {'L', 'L', 'P', 'R', 'T', '\r', '\n', '\x1a'};
  uint32_t version = kVersion;
  uint32_t coefficients = kShCoefficients;
  uint64_t key[2] = {};
  uint64_t vertices = 0;
  uint64_t checksum = 0;  // of the data that follow
};
static_assert(sizeof(Header) == 48 && std::is_trivially_copyable_v<Header>);
static_assert(sizeof(Transfer::Vertex) == 4 * kShCoefficients * sizeof(float));
static_assert(std::endian::native == std::endian::little);

// Hashes 64-bit words with a final mix; two hashes with different starts form a key.
class Hasher {
 public:
  explicit Hasher(uint64_t start = kHashStart) : hash_(start) {}
  void add(uint64_t word) {
    hash_ = hashedWith(hash_, word);
    hash_ ^= hash_ >> 32;  // moves high bits to the low half
  }
  void add(float v) { add(uint64_t{std::bit_cast<uint32_t>(v)}); }
  void add(const vec2& v) { add(v.x), add(v.y); }
  void add(const vec3& v) { add(v.x), add(v.y), add(v.z); }
  void add(const vec4& v) { add(v.x), add(v.y), add(v.z), add(v.w); }
  void addBytes(std::span<const uint8_t> bytes) {
    add(uint64_t{bytes.size()});
    forEachWord(bytes, [&](uint64_t word) { add(word); });
  }
  uint64_t value() const {
    uint64_t h = hash_;
    h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdu;
    h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53u;
    return h ^ (h >> 33);
  }

 private:
  uint64_t hash_;
};

void addTexture(Hasher& h, const RenderScene& own, const TextureRef& ref) {
  h.add(uint64_t{ref.texture != kNone});
  if (ref.texture == kNone) return;
  const Texture& texture = own.textures[static_cast<size_t>(ref.texture)];
  h.add(static_cast<uint64_t>(ref.texCoord));
  h.add(ref.offset);
  h.add(ref.rotation);
  h.add(ref.scale);
  h.add(static_cast<uint64_t>(texture.wrapS));
  h.add(static_cast<uint64_t>(texture.wrapT));
  h.add(uint64_t{texture.nearest});
  h.add(static_cast<uint64_t>(texture.image->width));
  h.add(static_cast<uint64_t>(texture.image->height));
  h.addBytes(texture.image->pixels);
  for (const vec2& uv : ref.texCoord == 1 ? own.uv1 : own.uv0) h.add(uv);
}

uint64_t hashOf(const RenderScene& own, const TransferOptions& options, uint64_t start) {
  Hasher h(start);
  h.add(uint64_t{kVersion});
  h.add(static_cast<uint64_t>(options.directions));
  h.add(static_cast<uint64_t>(options.bounces));
  h.add(uint64_t{own.positions.size()});
  for (const vec3& v : own.positions) h.add(v);
  for (const vec3& v : own.normals) h.add(v);
  h.add(uint64_t{own.indices.size()});
  for (const uint32_t i : own.indices) h.add(uint64_t{i});
  const Material& m = own.materials[0];
  h.add(uint64_t{m.isClear()});
  h.add(uint64_t{m.alphaMode == AlphaMode::mask});
  h.add(m.alphaCutoff);
  h.add(m.baseColor);
  for (const vec4& v : own.colors) h.add(v);
  addTexture(h, own, m.baseColorTexture);
  return h.value();
}

std::span<const uint8_t> bytesOf(const Transfer& transfer) {
  return {reinterpret_cast<const uint8_t*>(transfer.vertices.data()),
          transfer.vertices.size() * sizeof(Transfer::Vertex)};
}

uint64_t checksumOf(const Transfer& transfer) {
  Hasher h;
  h.addBytes(bytesOf(transfer));
  return h.value();
}

bool isFinite(const Transfer& transfer) {
  const auto finite = [](const ShVector& v) {
    return std::all_of(v.begin(), v.end(), [](float f) { return std::isfinite(f); });
  };
  return std::all_of(transfer.vertices.begin(), transfer.vertices.end(),
                     [&](const Transfer::Vertex& v) {
                       return finite(v.r) && finite(v.g) && finite(v.b) && finite(v.direct);
                     });
}

}  // namespace

TransferKey transferKey(const RenderScene& own, const TransferOptions& options) {
  return {hashOf(own, options, kHashStart), hashOf(own, options, 0x9e3779b97f4a7c15u)};
}

fs::path TransferCache::fileOf(const TransferKey& key) const {
  char name[40];
  std::snprintf(name, sizeof name, "%016llx%016llx.prt", static_cast<unsigned long long>(key[0]),
                static_cast<unsigned long long>(key[1]));
  return folder_ / name;
}

std::optional<Transfer> TransferCache::load(const TransferKey& key, size_t vertices) const {
  if (folder_.empty() || vertices > 0xffffffffu) return std::nullopt;
  const fs::path file = fileOf(key);
  std::error_code error;
  // The expected size comes from the request, not from the file.
  if (!fs::is_regular_file(file, error) ||
      fs::file_size(file, error) != sizeof(Header) + vertices * sizeof(Transfer::Vertex) || error)
    return std::nullopt;
  std::ifstream in(file, std::ios::binary);
  Header header;
  in.read(reinterpret_cast<char*>(&header), sizeof header);
  const Header expected;
  if (!in || std::memcmp(header.magic, expected.magic, sizeof header.magic) != 0 ||
      header.version != kVersion || header.coefficients != kShCoefficients ||
      header.key[0] != key[0] || header.key[1] != key[1] || header.vertices != vertices)
    return std::nullopt;
  Transfer out;
  out.vertices.resize(vertices);
  in.read(reinterpret_cast<char*>(out.vertices.data()),
          static_cast<std::streamsize>(bytesOf(out).size()));
  if (!in || checksumOf(out) != header.checksum || !isFinite(out)) return std::nullopt;
  return out;
}

bool TransferCache::save(const TransferKey& key, const Transfer& transfer) const {
  if (folder_.empty()) return false;
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) return false;
  std::string temporary = (folder_ / "saving-XXXXXX").string();
  const int descriptor = mkstemp(temporary.data());
  if (descriptor < 0) return false;
  Header header;
  std::copy(key.begin(), key.end(), header.key);
  header.vertices = transfer.vertices.size();
  header.checksum = checksumOf(transfer);
  std::FILE* out = fdopen(descriptor, "wb");
  bool isWritten = out != nullptr;
  if (out == nullptr) {
    close(descriptor);
  } else {
    const auto bytes = bytesOf(transfer);
    isWritten = std::fwrite(&header, sizeof header, 1, out) == 1 &&
                std::fwrite(bytes.data(), 1, bytes.size(), out) == bytes.size();
    isWritten = std::fclose(out) == 0 && isWritten;
  }
  if (isWritten) fs::rename(temporary, fileOf(key), error);
  if (isWritten && !error) return true;
  fs::remove(temporary, error);
  return false;
}

}  // namespace lamplighter
