#include "tests/guide/page.h"

#include <fstream>
#include <regex>
#include <sstream>

#include "renderer/base/error.h"
#include "tests/support/folders.h"

namespace lamplighter::test {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> wordsOf(const std::string& text) {
  std::vector<std::string> words;
  std::istringstream in(text);
  while (in >> std::ws && !in.eof()) {
    std::string word;
    if (in.peek() == '"') {
      in.get();
      std::getline(in, word, '"');
    } else {
      in >> word;
    }
    words.push_back(word);
  }
  return words;
}

std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

class Reader {
 public:
  explicit Reader(const fs::path& path) { page_.path = path; }

  void take(const std::string& text) {
    ++line_;
    if (isCode_)
      takeCode(text);
    else if (isSteps_)
      takeStep(trimmed(text));
    else if (text.starts_with("```"))
      beginCode(text.substr(3));
    else if (text == "<!-- steps")
      isSteps_ = true;
    else if (text.starts_with("<!-- play "))
      takePlay(text);
    else
      takeText(text);
  }
  Page finish() {
    if (isCode_ || isSteps_) fail("begins what never ends");
    return std::move(page_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(page_.at(line_), what, "tests/guide/page.h says how pages are written");
  }
  void beginCode(const std::string& language) {
    isCode_ = true;
    page_.blocks.push_back({line_, language, ""});
  }
  void takeCode(const std::string& text) {
    if (text.starts_with("```"))
      isCode_ = false;
    else
      page_.blocks.back().text += text + '\n';
  }
  void takeStep(const std::string& text) {
    if (text == "-->") {
      isSteps_ = false;
      return;
    }
    if (text.empty() || text.starts_with("#")) return;
    if (page_.sections.empty()) fail("has steps before the first heading");
    const size_t end = std::min(text.find(' '), text.size());
    const std::string rest = trimmed(text.substr(end));
    page_.sections.back().steps.push_back({line_, text.substr(0, end), wordsOf(rest), rest});
  }
  void takePlay(const std::string& text) {
    std::vector<std::string> words = wordsOf(text);  // <!-- play SCENE NAME=VALUE … -->
    if (words.size() < 4 || words.back() != "-->") fail("has a play comment without an end");
    page_.scene = words[2];
    for (size_t i = 3; i + 1 < words.size(); ++i) {
      const size_t equal = words[i].find('=');
      if (equal == std::string::npos) fail("has '" + words[i] + "' where NAME=VALUE is due");
      page_.values[words[i].substr(0, equal)] = words[i].substr(equal + 1);
    }
  }
  void takeText(const std::string& text) {
    if (text.starts_with("<!--")) fail("has a comment that is neither play nor steps");
    if (text.starts_with("#"))
      page_.sections.push_back({line_, trimmed(text.substr(text.find_first_not_of('#'))), "", {}});
    if (!page_.sections.empty()) page_.sections.back().text += text + '\n';
    static const std::regex kLink(R"((!?)\[[^\]]*\]\(([^)]*)\))");
    for (auto it = std::sregex_iterator(text.begin(), text.end(), kLink);
         it != std::sregex_iterator(); ++it)
      page_.links.push_back({line_, (*it)[2], (*it)[1].length() > 0});
  }

  Page page_;
  int line_ = 0;
  bool isCode_ = false, isSteps_ = false;
};

}  // namespace

std::string Page::pictureFile(const std::string& picture) const {
  return "../images/guide/" + name() + "." + picture + ".jpg";
}

Page readPage(const fs::path& path) {
  std::ifstream in(path);
  if (!in) throw InputError(path.string(), "cannot be read", "see that it is there");
  Reader reader(path);
  for (std::string line; std::getline(in, line);) reader.take(line);
  return reader.finish();
}

fs::path pagesFolder() { return test::sourceFolder() / "docs/user"; }

std::vector<Page> allPages() {
  return {readPage(pagesFolder() / "tutorial.md"), readPage(pagesFolder() / "guide.md")};
}

}  // namespace lamplighter::test
