// The part of parseIes() that reads: what the text of a profile says, and nothing computed from it.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "renderer/scene/ies/ies_profile.h"

namespace lamplighter {

// Without solid angle, cap and lobes. Throws InputError: what is wrong with `file`.
std::shared_ptr<IesProfile> parseIesTable(std::string_view text, const std::string& file);

}  // namespace lamplighter
