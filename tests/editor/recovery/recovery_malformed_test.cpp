// Malformed journals are not offered for recovery, and are refused with one line.
#include <fstream>

#include <gtest/gtest.h>

#include "editor/recovery/recovery.h"
#include "renderer/base/error.h"
#include "tests/support/scenes/gltf_files.h"

namespace lamplighter::test {
namespace {

namespace fs = std::filesystem;

class MalformedJournal : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(session_); }
  void expectRefused(const std::string& header, const std::string& line) {
    std::ofstream(session_ / "journal.jsonl", std::ios::binary)
        << "{\"lamplighter_journal\":1,\"level\":false,\"saved\":\"0\",\"scene\":\"\"," << header
        << "}\n"
        << line << "\n";
    EXPECT_TRUE(findRecoverable(session_.parent_path()).empty()) << header.substr(0, 80);
    EXPECT_THROW(recover(session_), InputError) << header.substr(0, 80);
  }

  TemporaryFolder folder_;
  fs::path session_ = folder_.path() / "root" / "session";
};

TEST_F(MalformedJournal, InvalidWholeNumbers) {
  for (const char* edits : {"1e300", "-1e300", "2147483647", "1.5", "-5", "99999999999", "null"})
    expectRefused(std::string("\"files\":[],\"edits\":") + edits, R"({"label":"","time":1})");
  expectRefused(R"("files":[],"edits":2)", R"({"label":"","time":1e300})");
}

// Recursive functions would overflow the stack.
TEST_F(MalformedJournal, DeeplyNestedJson) {
  const std::string deep = std::string(1'000'000, '[') + std::string(1'000'000, ']');
  expectRefused("\"edits\":2,\"files\":" + deep, deep);
}

}  // namespace
}  // namespace lamplighter::test
