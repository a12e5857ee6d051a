// Writing a file as a whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace lamplighter {

// Through a temporary file beside it that is renamed at the end. Throws InputError, with what was
// there as it was.
void writeFile(const std::filesystem::path& path, std::string_view content);

}  // namespace lamplighter
