// A sky as one word of text, for the command line and for actions.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/scene/sky.h"

namespace lamplighter {

inline constexpr const char* kSkyUsage = "none|R,G,B|gradient:ZENITH/HORIZON/GROUND|FILE";

// "none", "R,G,B" (or one number for all three) in W/(m² sr), "gradient:R,G,B/R,G,B/R,G,B" (zenith,
// horizon, ground), or the name of a picture; if it does not exist, it is searched in `folder`.
// Throws InputError.
Sky parseSky(const std::string& text, const std::filesystem::path& folder = {});

// The picture of that name, or of that name in `folder`. Throws InputError.
std::shared_ptr<const SkyImage> findSkyImage(const std::filesystem::path& file,
                                             const std::filesystem::path& folder);

}  // namespace lamplighter
