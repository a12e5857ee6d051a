// Converts every value that an edit can change to JSON and back, bit for bit. The lines of a
// journal contain these values. Readers throw InputError or nlohmann's exceptions for invalid
// values.
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "editor/document/document.h"
#include "editor/recovery/blobs.h"

namespace lamplighter {

using Json = nlohmann::ordered_json;

// Throws InputError: the journal is damaged.
[[noreturn]] void damagedJournal(const std::string& what);

// Reads an integer that fits T. The JSON library's own conversion is undefined for other values.
// Throws InputError.
template <std::integral T>
T wholeOf(const Json& json) {
  if (json.is_number_unsigned()) {
    if (const auto v = json.get<uint64_t>(); std::in_range<T>(v)) return static_cast<T>(v);
  } else if (json.is_number_integer()) {
    if (const auto v = json.get<int64_t>(); std::in_range<T>(v)) return static_cast<T>(v);
  }
  damagedJournal("a value is not a whole number");
}

// Converts a node, material, texture, mesh, camera, sky, state or group of lights, or bookmark.
template <typename T>
Json toJson(const T& value, Blobs& blobs);
template <typename T>
void fromJson(const Json& json, Blobs& blobs, T& value);

Json toJson(const RenderSettings& render, Blobs& blobs);
void fromJson(const Json& json, Blobs& blobs, RenderSettings& render);

}  // namespace lamplighter
