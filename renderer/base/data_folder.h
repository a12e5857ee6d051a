// Where the files are that the program reads besides its user's: shaders and assets.
#pragma once

#include <filesystem>

namespace lamplighter {

// share/lamplighter beside the folder of the running program, where the program was installed, and
// wherever that was moved; else the folder of the sources that it was built from.
std::filesystem::path dataFolder();

}  // namespace lamplighter
