// Texts from outside.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace lamplighter {

// ASCII letters as small ones.
inline std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// Line breaks as spaces, none of them at the end.
inline std::string oneLine(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace lamplighter
