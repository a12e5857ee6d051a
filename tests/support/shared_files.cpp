#include "tests/support/shared_files.h"

#include <cctype>
#include <fstream>
#include <sstream>

#include "tests/support/folders.h"

namespace lamplighter::test {

std::filesystem::path sharedScenes() { return test::sharedFolder() / "scenes"; }

std::vector<std::map<std::string, std::string>> readTable(const std::filesystem::path& path) {
  const auto cells = [](const std::string& line) {
    std::vector<std::string> out;
    std::stringstream in(line);
    for (std::string cell; std::getline(in, cell, '\t');) out.push_back(cell);
    return out;
  };
  std::ifstream in(path);
  std::vector<std::map<std::string, std::string>> rows;
  std::string line;
  if (!std::getline(in, line)) return rows;
  const std::vector<std::string> names = cells(line);
  while (std::getline(in, line)) {
    const std::vector<std::string> values = cells(line);
    std::map<std::string, std::string> row;
    for (size_t i = 0; i < names.size(); ++i) row[names[i]] = i < values.size() ? values[i] : "";
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string testNameOf(std::string file) {
  for (char& c : file)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return file;
}

}  // namespace lamplighter::test
