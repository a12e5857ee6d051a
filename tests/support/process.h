// Runs the program as a separate process.
#pragma once

#include <string>
#include <vector>

namespace lamplighter::test {

struct ProcessResult {
  int code = -1;  // exit code; −1: a signal ended the process
  std::string out, err;
};

// Runs the program with `arguments`, without a shell, standard input or DISPLAY. `output`: the file
// for standard output; if given, standard output is not in the result.
ProcessResult runLamplighter(const std::vector<std::string>& arguments,
                             const std::string& output = "");

// The number of lines in a text.
int lines(const std::string& text);

}  // namespace lamplighter::test
