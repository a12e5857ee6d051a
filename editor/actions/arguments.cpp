#include "editor/actions/arguments.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "editor/session/session.h"
#include "renderer/base/error.h"

namespace lamplighter {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string callText(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) {
    const bool isPlain = !word.empty() && word.find_first_of(" \"\\") == word.npos;
    text += (text.empty() ? "" : " ") + (isPlain ? word : quoted(word));
  }
  return text;
}

float numberOf(const std::string& text) {
  float v = 0.0f;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), v);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(v)) {
    throw InputError(text, "is not a number", "give one such as 1.5");
  }
  return v;
}

vec3 vectorOf(const Arguments& a, size_t from) {
  return {numberOf(a[from]), numberOf(a[from + 1]), numberOf(a[from + 2])};
}

const Node& nodeNamed(const Document& document, const std::string& name) {
  const auto& nodes = document.scene.nodes;
  const auto it =
      std::find_if(nodes.begin(), nodes.end(), [&](const Node& n) { return n.name == name; });
  if (it == nodes.end())
    throw InputError(name, "there is no object with this name", "the outliner lists them");
  return *it;
}

const Node& activeNode(const Document& document) {
  const Node* n = document.scene.find(document.active());
  if (n == nullptr) throw InputError("selection", "nothing is selected", "select an object first");
  return *n;
}

bool hasSelection(const Session& session) { return !session.document().selection.empty(); }

}  // namespace lamplighter
