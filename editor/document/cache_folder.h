// Where the program keeps what it can compute again.
#pragma once

#include <filesystem>

namespace lamplighter {

// Precomputed transfer: $XDG_CACHE_HOME/lamplighter/transfer, or ~/.cache for the first part (XDG
// Base Directory Specification). Empty where there is neither. Makes nothing.
std::filesystem::path transferFolder();

}  // namespace lamplighter
