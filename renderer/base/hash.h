// FNV-1a (Fowler, Noll and Vo) with 64 bits: hashes of contents, which are stored in files and
// compared between runs and machines. Not safe against input that is designed to collide.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace lamplighter {

inline constexpr uint64_t kHashStart = 0xcbf29ce484222325;

// The hash after one more value, a byte or a whole word.
constexpr uint64_t hashedWith(uint64_t hash, uint64_t value) {
  return (hash ^ value) * 0x100000001b3;
}

// `values` is a contiguous range; `hash`: of what comes before it.
template <typename Values>
uint64_t hashOfBytes(const Values& values, uint64_t hash = kHashStart) {
  for (const std::byte b : std::as_bytes(std::span(values)))
    hash = hashedWith(hash, std::to_integer<uint64_t>(b));
  return hash;
}

// Calls add(word) for the bytes of `values` as little-endian words; the last is filled with zeros.
template <typename Values, typename Add>
void forEachWord(const Values& values, const Add& add) {
  const auto bytes = std::as_bytes(std::span(values));
  for (size_t i = 0; i < bytes.size(); i += sizeof(uint64_t)) {
    uint64_t word = 0;
    std::memcpy(&word, &bytes[i], std::min(sizeof word, bytes.size() - i));
    add(word);
  }
}

}  // namespace lamplighter
