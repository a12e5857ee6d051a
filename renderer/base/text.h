// Helpers for text from files and users.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace lamplighter {

// Converts ASCII letters to lower case.
inline std::string lowerCase(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// Replaces line breaks by spaces and removes trailing spaces.
inline std::string oneLine(std::string text) {
  for (char& c : text) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace lamplighter
