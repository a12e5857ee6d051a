// GLSL from files, with #include "…" and #line, so that compiler messages can name the file.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace lamplighter::gl {

// A shader cannot be loaded, compiled or linked: an error in the program (or of someone who edits
// shaders, with F5). what() has several lines, "FILE:LINE: message".
class ShaderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The folder of the shaders: the source tree's `shaders`.
std::filesystem::path defaultShaderFolder();

struct ShaderSource {
  std::string text;  // with #version, the defines and #line
  // indexed by the source-string numbers of #line; relative to the folder
  std::vector<std::string> files;
};

// `file` is relative to `folder`. An #include "…" is relative to the including file if it exists
// there, otherwise to `folder`. Each file is included only once, as with #pragma once. #include <…>
// is only for C++ and is removed. `defines` are "NAME" or "NAME value". Throws ShaderError.
ShaderSource loadShader(const std::filesystem::path& folder, const std::string& file,
                        const std::vector<std::string>& defines = {});

// Replaces the source-string numbers in a driver's log by file names: "1:12(3): …" and "1(12) : …".
std::string nameFiles(const std::string& log, const std::vector<std::string>& files);

}  // namespace lamplighter::gl
