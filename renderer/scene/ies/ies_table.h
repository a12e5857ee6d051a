// The first step of parseIes(): reads the text without computing derived values.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "renderer/scene/ies/ies_profile.h"

namespace lamplighter {

// The result has no solid angle, cap and lobes. Throws InputError that names `file`.
std::shared_ptr<IesProfile> parseIesTable(std::string_view text, const std::string& file);

}  // namespace lamplighter
