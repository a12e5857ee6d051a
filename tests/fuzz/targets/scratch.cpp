#include "tests/fuzz/targets/scratch.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include <unistd.h>

namespace lamplighter::fuzz {

namespace fs = std::filesystem;

Scratch::Scratch() : process_(::getpid()) {
  std::error_code error;
  std::string name =
      (fs::is_directory("/dev/shm", error) ? "/dev/shm" : "/tmp") + std::string("/fuzz-XXXXXX");
  if (::mkdtemp(name.data()) == nullptr || ::chdir(name.c_str()) != 0) broken("no scratch folder");
  path_ = name;
  // Minimal files that the scenes of the corpus refer to.
  write("square.bin", std::string(84, '\x3f'));
  write("lamp.ies",
        "IESNA:LM-63-1995\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0\n1 1 50\n0 45 90\n0\n100 60 10\n");
}

Scratch::~Scratch() {
  std::error_code ignored;
  if (process_ == ::getpid()) fs::remove_all(path_, ignored);
}

fs::path Scratch::write(const std::string& name, std::string_view content) const {
  const fs::path file = path_ / name;
  std::ofstream(file, std::ios::binary) << content;
  return file;
}

const Scratch& scratch() {
  static const Scratch kScratch;
  return kScratch;
}

void broken(const std::string& what) {
  std::fprintf(stderr, "does not hold: %s\n", what.c_str());
  std::abort();
}

}  // namespace lamplighter::fuzz
