// What a long command has done so far.
#pragma once

#include <iostream>
#include <string>

#include <unistd.h>

namespace lamplighter::cli {

// One line on a terminal that is written over again and again and gone in the end, whichever way
// that comes, so that an error has its line to itself. Nothing where standard error is no terminal.
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
