#include "ui/app/user_files.h"

#include <fstream>
#include <optional>

#include "editor/document/write_file.h"
#include "editor/preferences/preferences_file.h"
#include "renderer/base/error.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMostBytes = 1 << 20;
// The number of frames without a change before settings are written, so that nothing is written
// while a slider is dragged.
constexpr int kFramesUnchanged = 30;

// None: the file does not exist, or it cannot be read and `problem` says why.
std::optional<std::string> contents(const fs::path& path, std::string& problem) {
  std::error_code error;
  if (!fs::exists(path, error)) return std::nullopt;
  if (!fs::is_regular_file(path, error) || fs::file_size(path, error) > kMostBytes || error) {
    problem = "is not a regular file, or is larger than 1 MB";
    return std::nullopt;
  }
  std::ifstream in(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (in.bad() || !in.is_open()) {
    problem = "cannot be read";
    return std::nullopt;
  }
  return text;
}

}  // namespace

bool UserFiles::putAside(const fs::path& file) {
  for (int i = 1; i < 1000; ++i) {
    const fs::path aside = file.string() + ".broken-" + std::to_string(i);
    std::error_code error;
    if (fs::exists(aside, error)) continue;
    fs::rename(file, aside, error);
    if (error) break;
    problems_.back() += "; the file is kept as " + aside.filename().string();
    return true;
  }
  problems_.back() += "; the file is not changed, and settings are not saved";
  return false;
}

Preferences UserFiles::readPreferences() {
  if (folder_.empty()) return {};
  const fs::path path = folder_ / "settings.json";
  std::vector<std::string> wrong(1);
  const std::optional<std::string> text = contents(path, wrong[0]);
  Preferences preferences;
  if (text) {
    wrong.clear();
    preferences = parsePreferences(*text, wrong);
    written_ = *text;
  }
  if (!wrong.empty() && !wrong[0].empty()) {
    std::string line = path.string() + ": " + wrong[0];
    if (wrong.size() > 1) line += " (and " + std::to_string(wrong.size() - 1) + " more like it)";
    problems_.push_back(line);
    writes_ = putAside(path);
    written_.clear();
  }
  last_ = preferences;
  return preferences;
}

KeyList UserFiles::readKeys() {
  if (folder_.empty()) return {};
  const fs::path path = folder_ / "keys.json";
  std::string problem;
  const std::optional<std::string> text = contents(path, problem);
  std::vector<std::string> wrong;
  const KeyList keys = text ? parseKeys(*text, wrong) : KeyList();
  if (!problem.empty()) wrong.push_back(problem + "; the default keys are used");
  for (const std::string& line : wrong) problems_.push_back(path.string() + ": " + line);
  return keys;
}

void UserFiles::keep(const Preferences& preferences) {
  unchanged_ = preferences == last_ ? unchanged_ + 1 : 0;
  last_ = preferences;
  if (unchanged_ == kFramesUnchanged) flush(preferences);
}

void UserFiles::flush(const Preferences& preferences) {
  if (folder_.empty() || !writes_) return;
  const std::string text = preferencesText(preferences);
  if (text == written_) return;
  // All values are defaults, so no file is needed.
  if (written_.empty() && preferences == Preferences()) return;
  try {
    std::error_code error;
    fs::create_directories(folder_, error);
    writeFile(folder_ / "settings.json", text);
    written_ = text;
  } catch (const InputError& e) {
    writes_ = false;
    writeProblem_ = e.what();
  }
}

std::string UserFiles::takeWriteProblem() { return std::exchange(writeProblem_, {}); }

}  // namespace lamplighter
