// Helpers that read the arguments of actions and ask about the session.
#pragma once

#include <string>
#include <vector>

#include "editor/document/document.h"
#include "renderer/base/math.h"

namespace lamplighter {

class Session;

using Arguments = std::vector<std::string>;

// Quotes a text so that the parser reads it as one argument.
std::string quoted(const std::string& text);
// The words of a call as one text: those with spaces or quotes are quoted.
std::string callText(const std::vector<std::string>& words);
float numberOf(const std::string& text);
// Reads three numbers, starting at argument `from`.
vec3 vectorOf(const Arguments& arguments, size_t from);
// The node with that name. Throws InputError if the document has none.
const Node& nodeNamed(const Document& document, const std::string& name);
// The active node. Throws InputError if nothing is selected.
const Node& activeNode(const Document& document);
// Whether anything is selected. Use as Action::enabled.
bool hasSelection(const Session& session);

}  // namespace lamplighter
