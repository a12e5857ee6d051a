#include "editor/document/write_file.h"

#include <fstream>
#include <string>

#include <unistd.h>

#include "renderer/error.h"

namespace lamplighter {

namespace fs = std::filesystem;

void writeFile(const fs::path& path, std::string_view content) {
  // Two processes that write the same file do not meet.
  fs::path temporary = path;
  temporary.replace_filename("." + path.filename().string() + "." + std::to_string(::getpid()));
  std::ofstream out(temporary, std::ios::binary);
  out.write(content.data(), static_cast<std::streamsize>(content.size()));
  out.close();
  std::error_code error;
  if (out) fs::rename(temporary, path, error);
  if (out && !error) return;
  std::error_code ignored;
  fs::remove(temporary, ignored);
  throw InputError(path.string(), "cannot be written", "check the folder and the space left");
}

}  // namespace lamplighter
