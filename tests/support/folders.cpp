#include "tests/support/folders.h"

namespace lamplighter::test {

// The paths are definitions of this source alone (tests/CMakeLists.txt). All others are compiled to
// the same object in every working tree, which ccache shares.
std::filesystem::path sourceFolder() { return LAMPLIGHTER_SOURCE_DIR; }
std::filesystem::path sharedFolder() { return LAMPLIGHTER_SHARED_DIR; }
std::filesystem::path programFile() { return LAMPLIGHTER_BINARY; }

}  // namespace lamplighter::test
