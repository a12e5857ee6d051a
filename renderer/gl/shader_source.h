// GLSL from files, with #include "…" and #line, so that a compiler's message can name the file.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace lamplighter::gl {

// A shader that does not load, compile or link: a fault of the program (or of whoever edits
// shaders, with F5). what() is "FILE:LINE: message", several lines.
class ShaderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The folder of the shaders: the source tree's `shaders`.
std::filesystem::path defaultShaderFolder();

struct ShaderSource {
  std::string text;                // with #version, the defines and #line
  std::vector<std::string> files;  // by the source-string numbers of #line, relative to the folder
};

// `file` is relative to `folder`, as is each #include "…" unless such a file stands beside the one
// that includes it. A file is taken in once, however often it is included, as with #pragma once.
// #include <…> is for C++ only and left out. `defines` are "NAME" or "NAME value". Throws
// ShaderError.
ShaderSource loadShader(const std::filesystem::path& folder, const std::string& file,
                        const std::vector<std::string>& defines = {});

// Puts the files' names for the numbers in a driver's log: "1:12(3): …" and "1(12) : …".
std::string nameFiles(const std::string& log, const std::vector<std::string>& files);

}  // namespace lamplighter::gl
