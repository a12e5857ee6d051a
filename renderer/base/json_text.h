// Parsing of untrusted JSON.
#pragma once

#include <cstddef>
#include <string_view>

namespace lamplighter {

// The JSON library copies and writes values recursively, so deep nesting would overflow the stack.
// The depth is checked before the library sees the text.
inline constexpr size_t kDeepestJson = 200;

// Depth of nested arrays and objects.
inline size_t nestingDepth(std::string_view text) {
  size_t depth = 0, deepest = 0;
  bool inString = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inString) {
      if (c == '\\') ++i;
      if (c == '"') inString = false;
    } else if (c == '"') {
      inString = true;
    } else if (c == '{' || c == '[') {
      deepest = deepest > ++depth ? deepest : depth;
    } else if ((c == '}' || c == ']') && depth > 0) {
      --depth;
    }
  }
  return deepest;
}

// Returns a discarded value (is_discarded()) if the text is not JSON or nests too deeply.
template <class Json>
Json parseJson(std::string_view text) {
  if (nestingDepth(text) > kDeepestJson) return Json(Json::value_t::discarded);
  return Json::parse(text, nullptr, false);
}

}  // namespace lamplighter
