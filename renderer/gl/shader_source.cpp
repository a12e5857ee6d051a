#include "renderer/gl/shader_source.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

#include "renderer/base/data_folder.h"

namespace lamplighter::gl {
namespace {

namespace fs = std::filesystem;

class Loader {
 public:
  explicit Loader(const fs::path& folder) : folder_(folder) {}

  void add(const std::string& file, const std::string& from) {
    const fs::path relative = fs::path(file).lexically_normal();
    const std::string name = relative.generic_string();
    if (std::find(out.files.begin(), out.files.end(), name) != out.files.end()) return;
    std::ifstream in(folder_ / relative);
    if (!in) {
      throw ShaderError((from.empty() ? "" : from + ": ") + "cannot read shader " +
                        (folder_ / relative).string());
    }
    const size_t number = out.files.size();
    out.files.push_back(name);
    std::string line;
    startAt(1, number);
    for (int n = 1; std::getline(in, line); ++n) {
      std::smatch match;
      if (std::regex_match(line, match, kInclude)) {
        const std::string here = name + ":" + std::to_string(n);
        const fs::path beside = relative.parent_path() / match[1].str();
        add((fs::exists(folder_ / beside) ? beside : fs::path(match[1].str())).string(), here);
        startAt(n + 1, number);
      } else if (std::regex_match(line, kForCpp)) {
        out.text += '\n';
      } else {
        out.text += line;
        out.text += '\n';
      }
    }
  }

  ShaderSource out;

 private:
  void startAt(int line, size_t number) {
    out.text += "#line " + std::to_string(line) + " " + std::to_string(number) + "\n";
  }

  inline static const std::regex kInclude{R"(\s*#\s*include\s*"([^"]+)\".*)"};
  inline static const std::regex kForCpp{R"(\s*#\s*(include\s*<.*|pragma\s+once\s*))"};
  fs::path folder_;
};

}  // namespace

fs::path defaultShaderFolder() { return dataFolder() / "shaders"; }

ShaderSource loadShader(const fs::path& folder, const std::string& file,
                        const std::vector<std::string>& defines) {
  Loader loader(folder);
  loader.out.text = "#version 450 core\n";
  for (const std::string& define : defines) loader.out.text += "#define " + define + "\n";
  loader.add(file, "");
  return std::move(loader.out);
}

std::string nameFiles(const std::string& log, const std::vector<std::string>& files) {
  static const std::regex kPlace(R"(^(\d+)(?::(\d+)(?:\(\d+\))?|\((\d+)\))\s*:\s*)");
  std::istringstream in(log);
  std::string out, line;
  while (std::getline(in, line)) {
    std::smatch match;
    if (std::regex_search(line, match, kPlace) && match[1].length() < 6 &&
        std::stoul(match[1]) < files.size()) {
      const std::string number = match[2].matched ? match[2].str() : match[3].str();
      out += files[std::stoul(match[1])] + ":" + number + ": " + match.suffix().str() + "\n";
    } else if (!line.empty()) {
      out += line + "\n";
    }
  }
  if (!out.empty()) out.pop_back();
  return out;
}

}  // namespace lamplighter::gl
