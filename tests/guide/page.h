// A page of the guide. Its comments contain the steps that produce its pictures.
//
//   <!-- play assets/tutorial/empty_room.gltf vpls=300 exposure=1.5 -->      once, at the top
//
//   Press `Ctrl+P`, type `light.add spot` and press `Enter`.
//   <!-- steps
//   key Ctrl+P
//   type light.add spot
//   key Enter
//   picture spot
//   -->
//   ![A spot ahead of the camera](../images/guide/tutorial.spot.jpg)
//
// steps.h lists the steps.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace lamplighter::test {

struct Step {
  int line = 0;  // in the page, from 1
  std::string verb;
  std::vector<std::string> words;  // after the verb; text in double quotes is one word
  std::string rest;                // the same as unparsed text
};

// A heading and the text below it.
struct Section {
  int line = 0;
  std::string heading;
  std::string text;  // the visible text, without code blocks
  std::vector<Step> steps;
};

struct CodeBlock {
  int line = 0;
  std::string language, text;
};

struct Link {
  int line = 0;
  std::string target;
  bool isPicture = false;
};

struct Page {
  std::filesystem::path path;
  std::string scene;                          // "": the page has no steps
  std::map<std::string, std::string> values;  // of the play comment
  std::vector<Section> sections;
  std::vector<CodeBlock> blocks;
  std::vector<Link> links;

  std::string name() const { return path.stem().string(); }
  std::string at(int line) const { return path.filename().string() + ":" + std::to_string(line); }
  // The file of a picture, relative to the folder of the page.
  std::string pictureFile(const std::string& picture) const;
};

// Throws InputError "PAGE:LINE: …".
Page readPage(const std::filesystem::path& path);
// docs/user/tutorial.md and docs/user/guide.md.
std::vector<Page> allPages();
std::filesystem::path pagesFolder();

}  // namespace lamplighter::test
