// Values as bytes, for files that only machines of one byte order read (content_cache.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

namespace lamplighter {

template <typename T>
void append(std::vector<uint8_t>& bytes, const T* values, size_t count) {
  static_assert(std::is_trivially_copyable_v<T>);
  const auto* first = reinterpret_cast<const uint8_t*>(values);
  bytes.insert(bytes.end(), first, first + count * sizeof(T));
}

// Takes values from the front of the bytes. Returns false if there are too few.
template <typename T>
bool take(std::span<const uint8_t>& bytes, T* values, size_t count) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (count > bytes.size() / sizeof(T)) return false;
  if (count > 0) std::memcpy(values, bytes.data(), count * sizeof(T));
  bytes = bytes.subspan(count * sizeof(T));
  return true;
}

}  // namespace lamplighter
