// Reading the arguments of actions, and what many of them ask of the session.
#pragma once

#include <string>
#include <vector>

#include "editor/document/document.h"
#include "renderer/base/math.h"

namespace lamplighter {

class Session;

using Arguments = std::vector<std::string>;

// Throws InputError unless there are `least` to `most` arguments.
void requireArguments(const Arguments& arguments, size_t least, size_t most,
                      const std::string& usage);
// A text as one argument, whatever is in it.
std::string quoted(const std::string& text);
float numberOf(const std::string& text);
// Three numbers from `from` on.
vec3 vectorOf(const Arguments& arguments, size_t from);
// The node of that name; throws InputError when there is none.
const Node& nodeNamed(const Document& document, const std::string& name);
// The active node; throws InputError when nothing is selected.
const Node& activeNode(const Document& document);
// Whether anything is selected: what actions on the selection need to be enabled.
bool hasSelection(const Session& session);

}  // namespace lamplighter
