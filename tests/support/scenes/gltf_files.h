// Writes glTF files for tests.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace lamplighter::test {

// A temporary folder of a test. The destructor removes it with its files.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  // Writes a file in the folder and returns its path.
  std::filesystem::path write(const std::string& name, const std::string& content) const;

 private:
  std::filesystem::path path_;
};

std::string readText(const std::filesystem::path& path);

// The bytes of a .glb.
std::string glb(const std::string& json, const std::string& binary);

// A small level with one of each feature: two nested nodes, a square with normals and texture
// coordinates, a strip, a sparse accessor, a textured material, a camera, a point and a rectangle
// light, a skin, an animation, an unknown extension, extras. `binary` receives its only buffer, for
// a .glb.
nlohmann::ordered_json everythingScene(std::string& binary);

}  // namespace lamplighter::test
