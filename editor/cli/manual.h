// Generates documentation of the command line: a man page, and a table of every flag.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace lamplighter::cli {

// roff text for man(1), following the conventions of man-pages(7).
std::string manPage(const CLI::App& app);
std::string flagTables(const CLI::App& app);  // Markdown

}  // namespace lamplighter::cli
