// The exception for bad input and wrong use. main() prints `error: ` and what(), and exits with 2.
#pragma once

#include <stdexcept>
#include <string>

namespace lamplighter {

// what() reads "FILE: what is wrong and where; what to do": one line, no trailing newline.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  InputError(const std::string& file, const std::string& wrong, const std::string& remedy)
      : std::runtime_error(file + ": " + wrong + "; " + remedy) {}
};

}  // namespace lamplighter
