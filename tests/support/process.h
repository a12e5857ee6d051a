// Runs the program as its callers do.
#pragma once

#include <string>
#include <vector>

namespace lamplighter::test {

struct ProcessResult {
  int code = -1;  // exit code; −1: ended by a signal
  std::string out, err;
};

// `arguments` after the program's name; the shell is not involved. No standard input, no DISPLAY.
// `output`: where standard output goes instead of into the result.
ProcessResult runLamplighter(const std::vector<std::string>& arguments,
                             const std::string& output = "");

// The number of lines in a text.
int lines(const std::string& text);

}  // namespace lamplighter::test
