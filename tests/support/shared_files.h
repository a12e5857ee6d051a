// Third-party scenes for tests, in a folder beside the repository that may be missing.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lamplighter::test {

// sharedFolder()/scenes; check with std::filesystem::exists().
std::filesystem::path sharedScenes();

// Reads the rows of a tab-separated table, with columns named by its first line. Empty if the file
// does not exist.
std::vector<std::map<std::string, std::string>> readTable(const std::filesystem::path& path);

// A valid test name: the file's name with '_' for all characters except letters and digits.
std::string testNameOf(std::string file);

}  // namespace lamplighter::test
