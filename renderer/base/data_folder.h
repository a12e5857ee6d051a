// The folder of the program's own files: shaders and assets.
#pragma once

#include <filesystem>

namespace lamplighter {

// An installed program, also one that was moved, uses share/lamplighter beside the folder of its
// executable. Otherwise this is the source folder that the program was built from.
std::filesystem::path dataFolder();

}  // namespace lamplighter
