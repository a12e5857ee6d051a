#include "renderer/prt/transfer_cache.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

static_assert(sizeof(Transfer::Vertex) == 4 * kShCoefficients * sizeof(float));

// Increase this when the computation or the file format changes.
constexpr uint32_t kVersion = 3;

void addTexture(ContentHash& h, const RenderScene& own, const TextureRef& ref) {
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
  ContentHash h;
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
  return h.key();
}

TransferCache::TransferCache(fs::path folder) : files_(std::move(folder), {"prt", kVersion}) {}

std::optional<Transfer> TransferCache::load(const TransferKey& key, size_t vertices) const {
  if (vertices > 0xffffffffu) return std::nullopt;
  const auto bytes = files_.load(key, vertices * sizeof(Transfer::Vertex));
  if (!bytes) return std::nullopt;
  Transfer out;
  out.vertices.resize(vertices);
  std::memcpy(out.vertices.data(), bytes->data(), bytes->size());
  if (!isFinite(out)) return std::nullopt;
  return out;
}

bool TransferCache::save(const TransferKey& key, const Transfer& transfer) const {
  return files_.save(key, {reinterpret_cast<const uint8_t*>(transfer.vertices.data()),
                           transfer.vertices.size() * sizeof(Transfer::Vertex)});
}

}  // namespace lamplighter
