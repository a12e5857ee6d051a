// Saving when the disk is full, the folder is read-only, or another program has changed the level.
#include <csignal>
#include <fstream>

#include <sys/resource.h>
#include <unistd.h>

#include "editor/document/write_file.h"
#include "editor/input/recording.h"
#include "editor/recovery/recovery.h"
#include "renderer/base/error.h"
#include "renderer/image/image_io.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/editor/session_fixture.h"
#include "tests/support/scenes/gltf_files.h"

namespace lamplighter::test {

namespace fs = std::filesystem;

namespace {

// Limits the size of files to a number of bytes, so that writing fails as on a full disk.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    was_ = std::signal(SIGXFSZ, SIG_IGN);
    ::getrlimit(RLIMIT_FSIZE, &limit_);
    const rlimit now{bytes, limit_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &now);
  }
  ~FullDisk() {
    ::setrlimit(RLIMIT_FSIZE, &limit_);
    std::signal(SIGXFSZ, was_);
  }

 private:
  void (*was_)(int) = nullptr;
  rlimit limit_{};
};

// Makes a folder read-only. Root ignores permissions, so it becomes the user nobody.
class ReadOnly {
 public:
  explicit ReadOnly(fs::path folder) : folder_(std::move(folder)) {
    fs::permissions(folder_, fs::perms::owner_read | fs::perms::owner_exec | fs::perms::group_read |
                                 fs::perms::group_exec | fs::perms::others_read |
                                 fs::perms::others_exec);
    if (::geteuid() == 0) isNobody_ = ::seteuid(65534) == 0;
  }
  ~ReadOnly() {
    if (isNobody_ && ::seteuid(0) != 0) std::abort();
    fs::permissions(folder_, fs::perms::owner_all);
  }

 private:
  fs::path folder_;
  bool isNobody_ = false;
};

class Saving : public testing::Test {
 protected:
  TemporaryFolder folder_;
  fs::path level_ = folder_.path() / "level.gltf", bin_ = folder_.path() / "level.bin";
  Session session_{std::make_unique<FrameRenderer>(makeCpuBackend())};

  void SetUp() override {
    Scene scene;
    addMesh(scene, squareMesh(10.0f, addMaterial(scene, vec3(0.6f))));
    scene.nodes.back().name = "floor";
    saveGltf(scene, level_);
    ASSERT_TRUE(fs::exists(bin_));
    open();
    act("light.add sphere");
  }
  void open() { session_.open(loadGltf(level_).scene, level_, {}); }
  bool act(const std::string& text) { return session_.runAction(text); }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& e : fs::recursive_directory_iterator(folder_.path()))
      names.push_back(fs::relative(e.path(), folder_.path()).string());
    std::sort(names.begin(), names.end());
    return names;
  }
  // Expects a message and no other effect.
  void expectRefused(const std::string& action, const std::string& message) {
    const std::vector<std::string> before = files();
    const std::string text = readText(level_);
    const uint64_t hash = documentHash(session_.document());
    EXPECT_FALSE(act(action));
    EXPECT_NE(session_.status().find(message), std::string::npos) << session_.status();
    EXPECT_EQ(session_.status().find('\n'), std::string::npos);
    EXPECT_TRUE(session_.modified());
    EXPECT_EQ(documentHash(session_.document()), hash);
    EXPECT_EQ(files(), before);
    EXPECT_EQ(readText(level_), text);
  }
};

TEST_F(Saving, AFullDiskIsReported) {
  {
    const FullDisk full(100);
    expectRefused("file.save", "cannot be written");
    expectRefused("file.save_as " + (folder_.path() / "other.glb").string(), "cannot be written");
  }
  EXPECT_TRUE(act("file.save"));
  EXPECT_FALSE(session_.modified());
}

TEST_F(Saving, AReadOnlyFolderIsReported) {
  const fs::path inner = folder_.path() / "inner";
  fs::create_directory(inner);
  fs::permissions(folder_.path(), fs::perms::all);
  const ReadOnly locked(inner);
  expectRefused("file.save_as " + (inner / "x.gltf").string(), "cannot be written");
  expectRefused("file.save_as " + (inner / "x.glb").string(), "cannot be written");
}

TEST_F(Saving, AMissingFolderIsReported) {
  expectRefused("file.save_as " + (folder_.path() / "none" / "x.gltf").string(),
                "cannot be written");
}

TEST_F(Saving, OtherFilesAreWrittenCompletelyOrNotAtAll) {
  const fs::path picture = folder_.path() / "p.png", exr = folder_.path() / "p.exr";
  const fs::path text = folder_.path() / "t.json";
  writeFile(text, "before");
  writePng(Image8(40, 30), picture);
  const std::string before = readText(picture);
  Recording recording;
  recording.path = folder_.path() / "r.jsonl";
  {
    const FullDisk full(10);
    EXPECT_THROW(writePng(Image8(64, 64), picture), InputError);
    EXPECT_THROW(writeExr(Image(64, 64), exr), InputError);
    EXPECT_THROW(writeFile(text, "much longer than before"), InputError);
    EXPECT_THROW(writeRecording(recording), InputError);
    EXPECT_FALSE(act("timeline.export " + (folder_.path() / "t.csv").string()));
  }
  EXPECT_EQ(readText(picture), before);
  EXPECT_EQ(readText(text), "before");
  EXPECT_EQ(files(), (std::vector<std::string>{"level.bin", "level.gltf", "p.png", "t.json"}));
}

TEST_F(Saving, TheJournalCatchesUpWhenThereIsSpaceAgain) {
  const fs::path root = folder_.path() / "state";
  session_.keepJournal(root, 1, [] { return int64_t{1}; });
  act("light.add disk");
  {
    const FullDisk full(
        fs::file_size(session_.crashRecovery().journal()->folder() / "journal.jsonl") + 9);
    act("light.add tube");
    EXPECT_NE(session_.status().find("The journal is not complete"), std::string::npos);
    EXPECT_EQ(session_.document().scene.nodes.size(), 4u);
  }
  act("edit.rename last");
  // Reads a copy, because the process still holds the lock.
  fs::copy(session_.crashRecovery().journal()->folder(), root / "copy");
  const Recovered r = recover(root / "copy");
  EXPECT_EQ(documentHash(r.document), documentHash(session_.document()));
}

TEST_F(Saving, NoticesThatTheFileWasChanged) {
  std::ofstream(level_, std::ios::app) << ' ';
  expectRefused("file.save", "another program has changed");
  EXPECT_EQ(session_.changedOnDisk(level_), std::vector{level_});
  // Saving under another name overwrites nothing.
  EXPECT_TRUE(act("file.save_as " + (folder_.path() / "mine.gltf").string())) << session_.status();
}

TEST_F(Saving, NoticesThatABufferWasChangedOrRemoved) {
  std::ofstream(bin_, std::ios::app) << 'x';
  expectRefused("file.save", "level.bin");
  expectRefused("file.save_as " + (folder_.path() / "mine.gltf").string(), "level.bin");
  fs::remove(bin_);
  expectRefused("file.save", "level.bin");
  // A .glb contains all data and does not use the changed buffer.
  EXPECT_TRUE(act("file.save_as " + (folder_.path() / "mine.glb").string())) << session_.status();
}

TEST_F(Saving, ForceOverwritesWithTheLoadedData) {
  const Mesh mesh = *session_.document().scene.meshes[0];
  std::ofstream(bin_, std::ios::binary) << std::string(fs::file_size(bin_), 'x');
  EXPECT_FALSE(act("file.save"));
  EXPECT_FALSE(act("file.save please"));
  EXPECT_TRUE(act("file.save force")) << session_.status();
  EXPECT_FALSE(session_.modified());
  const Scene again = loadGltf(level_).scene;
  EXPECT_EQ(again.nodes.size(), 2u);
  EXPECT_EQ(again.meshes[0]->primitives[0].positions, mesh.primitives[0].positions);
}

TEST_F(Saving, ItsOwnSavesDoNotCountAsChanges) {
  for (int i = 0; i < 3; ++i) {
    act("select.name floor");
    act("object.move 0 0 " + std::to_string(i + 1));
    act("light.add disk");
    EXPECT_TRUE(act("file.save")) << session_.status();
  }
  const fs::path other = folder_.path() / "other.gltf";
  EXPECT_TRUE(act("file.save_as " + other.string()));
  std::ofstream(level_, std::ios::app) << ' ';  // no longer the file of this session
  act("light.add disk");
  EXPECT_TRUE(act("file.save")) << session_.status();
  std::ofstream(other, std::ios::app) << ' ';
  EXPECT_FALSE(act("file.save"));
}

}  // namespace

}  // namespace lamplighter::test
