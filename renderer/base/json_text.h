// JSON from outside.
#pragma once

#include <cstddef>
#include <string_view>

namespace lamplighter {

// The JSON library copies and writes values recursively: a file of nothing but brackets would run
// over the stack. The depth has to be bounded before it sees the text.
inline constexpr size_t kDeepestJson = 200;

// How deep arrays and objects nest.
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

// Discarded (is_discarded()) where the text is no JSON, or nests too deep.
template <class Json>
Json parseJson(std::string_view text) {
  if (nestingDepth(text) > kDeepestJson) return Json(Json::value_t::discarded);
  return Json::parse(text, nullptr, false);
}

}  // namespace lamplighter
