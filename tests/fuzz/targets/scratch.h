// A temporary folder for the files of a fuzzed process, in memory if possible. It becomes the
// working folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace lamplighter::fuzz {

class Scratch {
 public:
  Scratch();
  ~Scratch();
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, std::string_view content) const;

 private:
  std::filesystem::path path_;
  int process_;
};

// The first call creates the folder and makes it the working folder.
const Scratch& scratch();

inline std::string_view textOf(const uint8_t* data, size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}
// Prints the violated condition and aborts, which the fuzzer reports as a crash.
[[noreturn]] void broken(const std::string& what);

}  // namespace lamplighter::fuzz
