// Writes a file completely or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace lamplighter {

// Uses a temporary file in the same folder that is renamed at the end. Throws InputError; the old
// file is then unchanged.
void writeFile(const std::filesystem::path& path, std::string_view content);

}  // namespace lamplighter
