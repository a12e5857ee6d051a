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

Json toJson(const Node& node, Blobs& blobs);
Json toJson(const Material& material, Blobs& blobs);
Json toJson(const Texture& texture, Blobs& blobs);
Json toJson(const Mesh& mesh, Blobs& blobs);
Json toJson(const Camera& camera, Blobs& blobs);
Json toJson(const Sky& sky, Blobs& blobs);
Json toJson(const LightState& state, Blobs& blobs);
Json toJson(const LightGroup& group, Blobs& blobs);
Json toJson(const CameraBookmark& bookmark, Blobs& blobs);
Json toJson(const RenderSettings& render, Blobs& blobs);

void fromJson(const Json& json, Blobs& blobs, Node& node);
void fromJson(const Json& json, Blobs& blobs, Material& material);
void fromJson(const Json& json, Blobs& blobs, Texture& texture);
void fromJson(const Json& json, Blobs& blobs, Mesh& mesh);
void fromJson(const Json& json, Blobs& blobs, Camera& camera);
void fromJson(const Json& json, Blobs& blobs, Sky& sky);
void fromJson(const Json& json, Blobs& blobs, LightState& state);
void fromJson(const Json& json, Blobs& blobs, LightGroup& group);
void fromJson(const Json& json, Blobs& blobs, CameraBookmark& bookmark);
void fromJson(const Json& json, Blobs& blobs, RenderSettings& render);

}  // namespace lamplighter
