// Results of slow computations on disk, each in a file named after a hash of its input.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "renderer/base/hash.h"
#include "renderer/base/math.h"

namespace lamplighter {

// 128 bits: two hashes of the same words with different starts.
using ContentKey = std::array<uint64_t, 2>;

// Makes a key of 64-bit words.
class ContentHash {
 public:
  void add(uint64_t word) {
    for (uint64_t& hash : hashes_) {
      hash = hashedWith(hash, word);
      hash ^= hash >> 32;  // moves high bits to the low half
    }
  }
  void add(float v) { add(uint64_t{std::bit_cast<uint32_t>(v)}); }
  void add(const vec2& v) { add(v.x), add(v.y); }
  void add(const vec3& v) { add(v.x), add(v.y), add(v.z); }
  void add(const vec4& v) { add(v.x), add(v.y), add(v.z), add(v.w); }
  void addBytes(std::span<const uint8_t> bytes) {
    add(uint64_t{bytes.size()});
    forEachWord(bytes, [&](uint64_t word) { add(word); });
  }
  ContentKey key() const { return {mixed(hashes_[0]), mixed(hashes_[1])}; }

 private:
  static uint64_t mixed(uint64_t h) {
    h = (h ^ (h >> 33)) * 0xff51afd7ed558ccdu;
    h = (h ^ (h >> 33)) * 0xc4ceb9fe1a85ec53u;
    return h ^ (h >> 33);
  }
  std::array<uint64_t, 2> hashes_{kHashStart, 0x9e3779b97f4a7c15u};
};

// A folder with one file for each result of one kind. No file is trusted: one that is damaged,
// truncated, of another version or of another input counts as missing.
class ContentCache {
 public:
  struct Kind {
    const char* extension;  // of the files
    uint32_t version;       // increase it when the computation or its format changes
  };
  // An empty path: nothing is kept. The folder is created by the first save().
  ContentCache(std::filesystem::path folder, Kind kind) : folder_(std::move(folder)), kind_(kind) {}

  // `size`: of the result, if the caller knows it; a file of another size counts as missing.
  std::optional<std::vector<uint8_t>> load(const ContentKey& key,
                                           std::optional<size_t> size = {}) const;
  // Writes under a temporary name first, so that no reader finds a partial file. Returns whether it
  // succeeded. A failure (disk full, no permission) is not an error: the result is computed again
  // next time.
  bool save(const ContentKey& key, std::span<const uint8_t> result) const;
  // Deletes the oldest files of this kind until the others take at most `bytes`.
  void keepWithin(uintmax_t bytes) const;

  std::filesystem::path fileOf(const ContentKey& key) const;

 private:
  std::filesystem::path folder_;
  Kind kind_;
};

}  // namespace lamplighter
