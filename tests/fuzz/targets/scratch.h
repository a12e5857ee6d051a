// A folder of its own for a fuzzed process, in memory where there is such a place: what is fuzzed
// reads files. The process works in it, and what it names elsewhere is not there.
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

// Made by the first call; the working folder from then on.
const Scratch& scratch();

inline std::string_view textOf(const uint8_t* data, size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}
// Says what does not hold, and stops the process as a crash does.
[[noreturn]] void broken(const std::string& what);

}  // namespace lamplighter::fuzz
