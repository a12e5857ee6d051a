// Checks that the names in the guide exist: actions, keys, flags, parameters and settings in
// backticks, flags of commands, and targets of links. All pictures are used, and the text mentions
// all keys and texts of the steps.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "editor/keys/key_bindings.h"
#include "editor/keys/key_presets.h"
#include "editor/session/register_actions.h"
#include "tests/guide/page.h"
#include "tests/guide/steps.h"
#include "tests/support/folders.h"
#include "tests/support/process.h"

namespace lamplighter::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::vector<std::string> matches(const std::string& text, const char* pattern) {
  std::vector<std::string> out;
  const std::regex regex(pattern);
  for (auto it = std::sregex_iterator(text.begin(), text.end(), regex);
       it != std::sregex_iterator(); ++it)
    out.push_back((*it)[1]);
  return out;
}

std::vector<std::string> ticked(const std::string& text) { return matches(text, "`([^`]+)`"); }

// All names that the program knows.
class Program {
 public:
  Program() {
    addAllActions(registry_);
    for (const std::string& preset : keyPresetNames()) {
      std::vector<std::string> problems;
      for (const auto& [text, chords] : resolveKeys(registry_, keysOfPreset(preset), {}, problems))
        for (const Chord& chord : chords) keys_.insert(chordText(chord));
      words_.insert(preset);
    }
    for (const json& m : json::parse(runLamplighter({"methods", "--json"}).out)) {
      words_.insert(m["name"]);
      for (const json& p : m["parameters"]) words_.insert(p["name"]);
    }
    for (const json& s : json::parse(runLamplighter({"settings", "--json"}).out))
      words_.insert(s["name"]);
    // A section of the manual begins with "## lamplighter bake" and lists the flags.
    std::istringstream manual(runLamplighter({"manual", "--markdown"}).out);
    std::string command;
    for (std::string line; std::getline(manual, line);) {
      if (line.starts_with("## ")) command = line.substr(line.rfind(' ') + 1);
      for (const std::string& flag : matches(line, "[`, ](--?[a-z][a-z-]*)")) {
        flags_[command].insert(flag);
        allFlags_.insert(flag);
      }
    }
  }

  bool isAction(const std::string& text) const {
    return registry_.find(text.substr(0, text.find(' '))) != nullptr;
  }
  bool isWord(const std::string& text) const { return words_.contains(text); }
  bool isFlag(const std::string& text) const { return allFlags_.contains(text); }
  // Bound keys, and keys of the camera, of fields and panels, and modifiers.
  bool isKey(const std::string& text) const {
    static const std::set<std::string> kOthers{"A", "D", "E", "W", "Ctrl", "Alt", "Shift", "Enter"};
    return keys_.contains(text) || kOthers.contains(text);
  }
  // The first unknown word of a command, or "".
  std::string unknownOf(const std::vector<std::string>& command) const {
    const bool hasSubcommand = command.size() > 1 && flags_.contains(command[1]);
    const auto& flags = flags_.at(hasSubcommand ? command[1] : "lamplighter");
    for (size_t i = 1; i < command.size(); ++i)
      if (command[i].starts_with("-") && !flags.contains(command[i]) && command[i] != "--help")
        return command[i];
    const bool isFile = command.size() == 1 || command[1].find('.') != std::string::npos ||
                        command[1].starts_with("-");
    return hasSubcommand || isFile ? "" : command[1];
  }

 private:
  ActionRegistry registry_;
  std::set<std::string> keys_, words_, allFlags_;
  std::map<std::string, std::set<std::string>> flags_;
};

const Program& program() {
  static const Program kProgram;
  return kProgram;
}

std::vector<std::string> split(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

bool isFile(const std::string& text) {
  static const std::regex kEnding(R"([\w./-]+\.(gltf|glb|json|jsonl|exr|png|txt|md))");
  return text.starts_with("/") || std::regex_match(text, kEnding) || text == ".gltf" ||
         text == ".glb" || fs::exists(test::sourceFolder() / text);
}

bool isNumber(const std::string& text) {
  return text.find_first_not_of("-0123456789.") == std::string::npos;
}

// Returns why a text in backticks is not a known name, or "".
std::string problemOf(const Page& page, const std::string& text) {
  std::set<std::string> typed{"settled", "door", "guide_tests"};
  for (const Section& section : page.sections)
    for (const Step& step : section.steps)
      if (step.verb == "type") typed.insert(step.rest);
  for (const CodeBlock& block : page.blocks)
    for (const std::string& word : split(block.text)) typed.insert(word);
  if (typed.contains(text) || isFile(text)) return "";
  if (isNumber(text)) return text.size() > 1 || program().isKey(text) ? "" : "is not a key";
  if (text.starts_with("--")) return program().isFlag(split(text)[0]) ? "" : "is not a flag";
  if (text.starts_with("lamplighter")) {
    const std::string unknown = program().unknownOf(split(text));
    return unknown.empty() ? "" : unknown + " is not known to lamplighter";
  }
  if (text.starts_with("./dev ")) {
    std::ifstream in(test::sourceFolder() / "dev");
    const std::string dev{std::istreambuf_iterator<char>(in), {}};
    return dev.find("\n  " + text.substr(6) + ")") != std::string::npos ? ""
                                                                        : "is not a command of dev";
  }
  if (text.find('.') != std::string::npos)
    return program().isAction(text) ? "" : "is not an action";
  if (std::isupper(static_cast<unsigned char>(text[0])))
    return program().isKey(text) ? "" : "is not a key";
  return program().isWord(text) ? "" : "is not a parameter, method or setting";
}

TEST(GuideNames, EverythingInBackticksExists) {
  size_t count = 0;
  for (const Page& page : allPages()) {
    for (const Section& section : page.sections) {
      for (const std::string& text : ticked(section.text)) {
        ++count;
        EXPECT_EQ(problemOf(page, text), "") << page.at(section.line) << ": `" << text << "`";
      }
    }
  }
  EXPECT_GT(count, 150u);
}

TEST(GuideNames, UnknownNamesAreFound) {
  const Page page = readPage(pagesFolder() / "guide.md");
  for (const char* text : {"light.plaice", "--ssp", "Ctrl+J", "J", "vlps", "lamplighter rendre",
                           "lamplighter render --ssp", "./dev guid", "Shift+Ctrl+Alt"})
    EXPECT_NE(problemOf(page, text), "") << text;
  for (const char* text : {"light.place spot", "--spp", "Ctrl+P", "1", "vpls", "lamplighter render",
                           "lamplighter bake --density", "./dev guide", "ui_scale"})
    EXPECT_EQ(problemOf(page, text), "") << text;
}

TEST(GuideNames, FlagsOfCommandsExist) {
  size_t count = 0;
  for (const Page& page : allPages()) {
    for (const CodeBlock& block : page.blocks) {
      std::istringstream in(block.text);
      for (std::string line; std::getline(in, line);) {
        if (!line.starts_with("lamplighter ")) continue;
        ++count;
        EXPECT_EQ(program().unknownOf(split(line)), "") << page.at(block.line) << ": " << line;
      }
    }
  }
  EXPECT_GT(count, 8u);
}

// "*Light / Add light / Sun*": each part is the label of an action, one of its choices, or a menu.
TEST(GuideNames, MenuPathsLeadToActions) {
  std::set<std::string> known{"File",    "Edit",   "Light",  "Object",         "Tool",  "View",
                              "Inspect", "Render", "Camera", "Click to place", "Engine"};
  for (const json& a : json::parse(runLamplighter({"actions", "--json"}).out)) {
    known.insert(a["label"]);
    for (std::string choice : matches(a["arguments"].get<std::string>(), "([a-z]+)")) {
      choice[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(choice[0])));
      known.insert(choice);
    }
  }
  size_t count = 0;
  for (const Page& page : allPages()) {
    for (const Section& section : page.sections) {
      for (const std::string& way : matches(section.text, R"(\*([^*\n]+ / [^*\n]+)\*)")) {
        for (const std::string& part : matches(way + " / ", "(.+?) / ")) {
          ++count;
          EXPECT_TRUE(known.contains(part)) << page.at(section.line) << ": *" << way << "*";
        }
      }
    }
  }
  EXPECT_GT(count, 20u);
}

// The anchor of a heading: "How this page is made" is #how-this-page-is-made.
std::string anchorOf(const std::string& heading) {
  std::string out;
  for (const char c : heading) {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_')
      out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (c == ' ')
      out += '-';
  }
  return out;
}

bool hasAnchor(const fs::path& path, const std::string& anchor) {
  std::ifstream in(path);
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("#")) continue;
    if (anchorOf(line.substr(line.find_first_not_of("# "))) == anchor) return true;
  }
  return false;
}

TEST(GuideLinks, LeadToFilesAndHeadings) {
  for (const Page& page : allPages()) {
    for (const Link& link : page.links) {
      const size_t hash = std::min(link.target.find('#'), link.target.size());
      const std::string file = link.target.substr(0, hash);
      const fs::path path = file.empty() ? page.path : page.path.parent_path() / file;
      EXPECT_TRUE(fs::exists(path)) << page.at(link.line) << ": " << link.target;
      if (hash == link.target.size()) continue;
      EXPECT_TRUE(hasAnchor(path, link.target.substr(hash + 1)))
          << page.at(link.line) << ": " << link.target;
    }
  }
}

// Each picture is shown once, in the page with its steps, and after them.
TEST(GuideLinks, PicturesMatchTheSteps) {
  std::set<std::string> shown;
  for (const Page& page : allPages()) {
    std::vector<std::string> taken, linked;
    for (const std::string& name : picturesOf(page)) taken.push_back(page.pictureFile(name));
    for (const Link& link : page.links)
      if (link.isPicture) linked.push_back(link.target);
    EXPECT_EQ(linked, taken) << page.path;
    for (const std::string& file : linked) shown.insert(fs::path(file).filename());
  }
  uintmax_t bytes = 0;
  for (const auto& entry : fs::directory_iterator(pagesFolder() / "../images/guide")) {
    EXPECT_TRUE(shown.contains(entry.path().filename()))
        << entry.path() << " is not used in a page";
    bytes += entry.file_size();
  }
  EXPECT_LT(bytes, 3u << 20) << "all pictures together";
}

// The text of a section mentions the keys and texts of its steps.
TEST(GuideSteps, AreMentionedInTheText) {
  for (const Page& page : allPages()) {
    bool knowsEnter = false;  // Enter ends every typed number
    for (const Section& section : page.sections) {
      std::vector<std::string> told = ticked(section.text);
      knowsEnter |= std::find(told.begin(), told.end(), "Enter") != told.end();
      if (knowsEnter) told.emplace_back("Enter");
      for (const Step& step : section.steps) {
        const bool isInput = step.verb == "key" || step.verb == "type" || step.verb == "hold";
        if (!isInput) continue;
        EXPECT_TRUE(std::find(told.begin(), told.end(), step.rest) != told.end())
            << page.at(step.line) << ": `" << step.rest << "` is not in the text of \""
            << section.heading << '"';
      }
    }
  }
}

}  // namespace
}  // namespace lamplighter::test
