// Frames in which everything moves.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lamplighter {

// Moves the first light, an object near it and the camera for some frames at 640 x 360, and prints
// the mean time of the frames after the first, by stage. `picture`: where the last frame is
// written; empty: nowhere. `camera`: name of the camera node; empty: the first one. `set`: each
// NAME=VALUE of a parameter. Throws InputError.
void printMoving(const std::filesystem::path& file, const std::string& camera,
                 const std::string& method, const std::vector<std::string>& set,
                 const std::filesystem::path& picture);

}  // namespace lamplighter
