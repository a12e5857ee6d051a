// Shows the progress of a long command.
#pragma once

#include <iostream>
#include <string>

#include <unistd.h>

namespace lamplighter::cli {

// One line on a terminal that is overwritten with each update. The destructor erases it, so that an
// error message starts on an empty line. Prints nothing if standard error is not a terminal.
class ProgressLine {
 public:
  ~ProgressLine() {
    if (shown_) std::cerr << "\r\033[K" << std::flush;
  }
  void show(const std::string& text) {
    if (!terminal_) return;
    std::cerr << "\r\033[K" << text << std::flush;
    shown_ = true;
  }
  bool isTerminal() const { return terminal_; }

 private:
  bool terminal_ = ::isatty(STDERR_FILENO) == 1;
  bool shown_ = false;
};

}  // namespace lamplighter::cli
