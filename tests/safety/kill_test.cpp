// Kills a process with SIGKILL at random moments while it edits, and recovers its work. All
// confirmed steps must be recovered. LAMPLIGHTER_KILLS is the number of kills.
#include <array>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include "editor/input/recording.h"
#include "editor/recovery/recovery.h"
#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/safety/random_edits.h"
#include "tests/support/folders.h"

namespace lamplighter::test {

namespace fs = std::filesystem;

namespace {

fs::path levelFile() { return test::sourceFolder() / "assets/scenes/default.gltf"; }

std::unique_ptr<Session> editing(const fs::path& journal, const fs::path& level) {
  auto session = std::make_unique<Session>(std::make_unique<FrameRenderer>(makeCpuBackend()));
  session->keepJournal(journal, ::getpid(), [] { return int64_t{1'000'000'000}; });
  session->open(loadGltf(level).scene, level, {});
  return session;
}

// The process that is killed. It prints the hash of the document after each confirmed step, and
// sometimes saves or autosaves the level.
int editForEver(uint64_t seed, const fs::path& journal, const fs::path& level) {
  const auto session = editing(journal, level);
  RandomEdits edits(*session, seed, {60, false});
  for (uint64_t i = 0;; ++i) {
    edits.step();
    if (edits.below(40) == 0) session->autosave();
    if (edits.below(60) == 0) session->save(level);
    if (!session->crashRecovery().journal()) return 1;
    const std::string line = hashText(documentHash(session->document())) + "\n";
    if (::write(STDOUT_FILENO, line.data(), line.size()) < 0) return 1;
  }
}

class Child {
 public:
  Child(uint64_t seed, const fs::path& journal, const fs::path& level) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
    // Starts this program again, because a fork would inherit locks without their threads.
    std::string number = std::to_string(seed), folder = journal.string(), file = level.string();
    std::string self = "/proc/self/exe", mode = "--edit-for-ever";
    char* arguments[] = {self.data(),   mode.data(), number.data(),
                         folder.data(), file.data(), nullptr};
    process_ = ::fork();
    if (process_ == 0) {
      ::dup2(ends[1], STDOUT_FILENO);
      ::execv(self.c_str(), arguments);
      ::_exit(127);
    }
    ::close(ends[1]);
    pipe_ = ends[0];
  }
  ~Child() { ::close(pipe_); }

  // Reads a number of lines, waits, kills the process, and reads the rest.
  std::vector<std::string> killAfter(size_t lines, int microseconds) {
    std::string text;
    const auto read = [&] {
      std::array<char, 4096> block;
      const ssize_t n = ::read(pipe_, block.data(), block.size());
      if (n > 0) text.append(block.data(), static_cast<size_t>(n));
      return n > 0;
    };
    while (static_cast<size_t>(std::count(text.begin(), text.end(), '\n')) < lines && read()) {
    }
    ::usleep(static_cast<useconds_t>(microseconds));
    ::kill(process_, SIGKILL);
    while (read()) {
    }
    int status = 0;
    ::waitpid(process_, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status))
        << "the process ended before the kill with " << WEXITSTATUS(status);
    std::vector<std::string> out;
    for (size_t at = 0, end = text.find('\n'); end != std::string::npos;
         at = end + 1, end = text.find('\n', at))
      out.push_back(text.substr(at, end - at));
    return out;
  }

 private:
  pid_t process_ = 0;
  int pipe_ = -1;
};

struct Expected {
  std::string hash;
  bool isModified = false;  // since the last save
};

// The documents after each of the same steps, including the step after the last confirmed one.
std::vector<Expected> expectedWith(uint64_t seed, const fs::path& level, size_t confirmed) {
  saveGltf(loadGltf(levelFile()).scene, level);
  Session session(std::make_unique<FrameRenderer>(makeCpuBackend()));
  session.open(loadGltf(level).scene, level, {});
  RandomEdits edits(session, seed, {60, false});
  std::vector<Expected> out;
  for (size_t i = 0; i < confirmed + 1; ++i) {
    edits.step();
    if (edits.below(40) == 0) session.autosave();
    if (edits.below(60) == 0) session.save(level);
    out.push_back({hashText(documentHash(session.document())), session.modified()});
  }
  return out;
}

TEST(Kill, NothingConfirmedIsLost) {
  const char* count = std::getenv("LAMPLIGHTER_KILLS");
  const int kills = count != nullptr ? std::atoi(count) : 20;
  const fs::path root = fs::path(testing::TempDir()) / ("kill-" + std::to_string(::getpid()));
  uint64_t random = 1;
  size_t confirmed = 0, ahead = 0, recoveries = 0;
  for (int k = 0; k < kills && !HasFailure(); ++k) {
    const fs::path folder = root / std::to_string(k);
    fs::create_directories(folder / "check");
    const fs::path level = folder / "level.glb";
    saveGltf(loadGltf(levelFile()).scene, level);
    random = random * 6364136223846793005ull + 1442695040888963407ull;
    const uint64_t seed = 1000 + static_cast<uint64_t>(k);
    Child child(seed, folder / "journal", level);
    const std::vector<std::string> hashes =
        child.killAfter(1 + (random >> 33) % 80, static_cast<int>((random >> 20) % 3000));
    ASSERT_FALSE(hashes.empty());
    confirmed += hashes.size();
    const std::vector<Expected> expected =
        expectedWith(seed, folder / "check" / "level.glb", hashes.size());
    for (size_t i = 0; i < hashes.size(); ++i)
      ASSERT_EQ(hashes[i], expected[i].hash) << "step " << i;
    const Expected& next = expected.back();

    const std::vector<Recoverable> found = findRecoverable(folder / "journal");
    if (found.empty()) {
      // All work was saved in the file of the level.
      EXPECT_FALSE(expected[hashes.size() - 1].isModified && next.isModified) << "kill " << k;
      continue;
    }
    ASSERT_EQ(found.size(), 1u);
    const Recovered recovered = recover(found.front().folder);
    EXPECT_EQ(recovered.warning, "");
    const std::string now = hashText(documentHash(recovered.document));
    // The last confirmed step, or the step that was in progress.
    EXPECT_TRUE(now == hashes.back() || now == next.hash)
        << "kill " << k << " after " << hashes.size() << " steps: recovered " << now
        << ", confirmed " << hashes.back() << ", next " << next.hash;
    ahead += now != hashes.back();
    ++recoveries;
    fs::remove_all(folder);
  }
  fs::remove_all(root);
  std::cout << kills << " kills, " << confirmed << " confirmed steps, " << recoveries
            << " recoveries, " << ahead << " of them with the step that was in progress\n";
}

}  // namespace

}  // namespace lamplighter::test

int main(int argc, char** argv) {
  if (argc == 5 && std::string(argv[1]) == "--edit-for-ever")
    return lamplighter::test::editForEver(std::strtoull(argv[2], nullptr, 10), argv[3], argv[4]);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
