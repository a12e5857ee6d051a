// The text of an exception for the user.
#pragma once

#include <exception>
#include <string>

namespace lamplighter {

// One line, for a message of the editor or behind "error: " of the command line.
std::string failureText(const std::exception& e);

}  // namespace lamplighter
