// The scenes of other people that tests read: a folder beside the repository, which may be absent.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lamplighter::test {

// LAMPLIGHTER_SHARED_DIR/scenes; check with std::filesystem::exists().
std::filesystem::path sharedScenes();

// The rows of a table with tabs between columns, by the names in its first line. Empty where there
// is no such file.
std::vector<std::map<std::string, std::string>> readTable(const std::filesystem::path& path);

}  // namespace lamplighter::test
