// The folders and programs that tests use.
#pragma once

#include <filesystem>

namespace lamplighter::test {

// The working tree.
std::filesystem::path sourceFolder();
// Third-party files, in a folder beside the working tree that may be missing.
std::filesystem::path sharedFolder();
// The program of this build.
std::filesystem::path programFile();

}  // namespace lamplighter::test
