#include "renderer/visibility/object_identity.h"

#include <array>
#include <concepts>
#include <cstring>
#include <map>
#include <numeric>
#include <tuple>

#include <tbb/parallel_for.h>

#include "renderer/base/hash.h"

namespace lamplighter {
namespace {

// Hashes words, in several independent sums to hide the latency of the multiplication.
class Hash {
 public:
  Hash() { sums_.fill(kHashStart); }
  template <typename T>
  void add(const T* values, size_t count) {
    static_assert(sizeof(T) % sizeof(uint32_t) == 0);
    const auto* bytes = reinterpret_cast<const char*>(values);
    add(count * (sizeof(T) / sizeof(uint32_t)), [&](size_t i) {
      uint32_t word;
      std::memcpy(&word, bytes + i * sizeof word, sizeof word);
      return word;
    });
  }
  // Adds wordAt(i) for each i < count.
  template <typename WordAt>
  void add(size_t count, const WordAt& wordAt) requires std::invocable<WordAt, size_t> {
    size_t i = 0;
    for (; i + kSums <= count; i += kSums)
      for (size_t s = 0; s < kSums; ++s) sums_[s] = hashedWith(sums_[s], wordAt(i + s));
    for (; i < count; ++i) sums_[0] = hashedWith(sums_[0], wordAt(i));
  }
  uint64_t value() const {
    return std::accumulate(sums_.begin(), sums_.end(), kHashStart, hashedWith);
  }

 private:
  static constexpr size_t kSums = 8;

  std::array<uint64_t, kSums> sums_;
};

}  // namespace

ObjectIdentity identify(const RenderScene& s, uint32_t index) {
  const RenderObject& o = s.objects[index];
  const Material& m = s.materials[static_cast<size_t>(o.material)];
  ObjectIdentity id;
  id.node = o.node;
  id.kind = o.kind;
  id.leftOutBy = o.leftOutBy;
  id.isClear = m.isClear();
  id.isMasked = m.alphaMode == AlphaMode::mask;
  id.backIsUnseen = s.backIsUnseen(index);
  id.hasNormalTexture = m.normalTexture.texture != kNone;
  Hash hash;
  hash.add(&s.positions[o.firstVertex], o.vertexCount);
  hash.add(&s.normals[o.firstVertex], o.vertexCount);
  hash.add(o.indexCount, [&](size_t i) { return s.indices[o.firstIndex + i] - o.firstVertex; });
  id.geometry = hash.value();
  return id;
}

std::vector<ObjectIdentity> identify(const RenderScene& scene) {
  std::vector<ObjectIdentity> all(scene.objects.size());
  tbb::parallel_for(size_t{0}, all.size(),
                    [&](size_t i) { all[i] = identify(scene, static_cast<uint32_t>(i)); });
  return all;
}

std::vector<int> findSame(const std::vector<ObjectIdentity>& before,
                          const std::vector<ObjectIdentity>& now) {
  using Key = std::tuple<NodeId, uint64_t>;
  std::multimap<Key, int> known;
  for (size_t i = 0; i < before.size(); ++i)
    known.emplace(Key{before[i].node, before[i].geometry}, static_cast<int>(i));
  std::vector<int> same(now.size(), kNone);
  for (size_t i = 0; i < now.size(); ++i) {
    const auto [first, last] = known.equal_range({now[i].node, now[i].geometry});
    for (auto it = first; it != last; ++it) {
      if (!(before[static_cast<size_t>(it->second)] == now[i])) continue;
      same[i] = it->second;
      known.erase(it);
      break;
    }
  }
  return same;
}

}  // namespace lamplighter
