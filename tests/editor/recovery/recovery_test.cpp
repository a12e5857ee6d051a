#include "editor/recovery/recovery.h"

#include <fstream>

#include "editor/edits/edits.h"
#include "editor/recovery/document_delta.h"
#include "renderer/base/error.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/ies/ies_profile.h"
#include "tests/editor/session_fixture.h"
#include "tests/support/scenes/gltf_files.h"

namespace lamplighter::test {

namespace fs = std::filesystem;

namespace {

std::unique_ptr<Session> sessionWith(const fs::path& root, int process = 7) {
  auto session = std::make_unique<Session>(std::make_unique<FrameRenderer>(makeCpuBackend()));
  session->keepJournal(root, process, [] { return int64_t{1'000'000}; });
  return session;
}

class Recovery : public testing::Test {
 protected:
  TemporaryFolder folder_;
  fs::path root_ = folder_.path() / "state", level_ = folder_.path() / "level.gltf";
  std::unique_ptr<Session> session_;

  void SetUp() override {
    Scene scene;
    const int grey = addMaterial(scene, vec3(0.6f));
    addMesh(scene, squareMesh(10.0f, grey));
    scene.nodes.back().name = "floor";
    addRectangleLight(scene, vec3(0, 4, 0), vec2(1.0f), vec3(10.0f));
    saveGltf(scene, level_);
    session_ = sessionWith(root_);
    open(*session_, level_);
  }
  static void open(Session& session, const fs::path& level) {
    session.open(loadGltf(level).scene, level, {});
  }
  void act(const std::string& text) {
    ASSERT_TRUE(session_->runAction(text)) << session_->status();
  }
  // Simulates a crash: nothing is closed, and only the lock disappears.
  Recovered killAndRecover() {
    const Document was = session_->document();
    session_.reset();
    const auto found = findRecoverable(root_);
    EXPECT_EQ(found.size(), 1u);
    Recovered r = recover(found.at(0).folder);
    EXPECT_EQ(r.warning, "");
    EXPECT_EQ(documentHash(r.document), documentHash(was));
    EXPECT_EQ(r.document.path, was.path);
    EXPECT_EQ(r.document.scene.nodes, was.scene.nodes);
    return r;
  }
  fs::path journal() { return session_->crashRecovery().journal()->folder() / "journal.jsonl"; }
};

TEST_F(Recovery, WritesNothingUntilSomethingIsEdited) {
  act("select.all");
  EXPECT_FALSE(fs::exists(root_));
  session_.reset();
  EXPECT_TRUE(findRecoverable(root_).empty());
}

TEST_F(Recovery, RestoresEveryCommittedEdit) {
  act("light.add sphere");
  act("edit.rename \"hall \\\"north\\\"\"");
  act("object.move 1 2 3");
  act("lights.group evening");
  act("edit.undo");
  act("render.set vpls=33");
  act("render.exposure -1.5");
  session_->setSky(Sky::gradient(vec3(0.1f), vec3(0.2f, 0.3f, 1e-30f), vec3(0)));
  Material m = session_->document().scene.materials[0];
  m.baseColor.x = 0.123456789f;
  session_->setMaterial(0, m);
  act("select.name floor");
  act("edit.duplicate");
  act("edit.delete");
  const Recovered r = killAndRecover();
  EXPECT_EQ(r.edits, 11);
  EXPECT_EQ(r.labels.size(), 11u);
  EXPECT_EQ(r.labels[4], "Undo: " + r.labels[3]);
}

TEST_F(Recovery, KeepsTheTreeAndItsOrder) {
  act("light.add disk");
  act("edit.rename lamp");
  act("light.add sphere");
  act("object.reparent floor");
  act("select.name floor");
  act("object.reparent lamp");
  act("edit.duplicate");
  act("edit.undo");
  act("select.name lamp");
  act("edit.cut");
  act("edit.undo");
  act("edit.paste");
  EXPECT_EQ(killAndRecover().edits, 10);
}

TEST_F(Recovery, ADragIsOneEditWhenItEnds) {
  const NodeId id = session_->document().scene.nodes.back().id;
  Transform t = session_->document().scene.nodes.back().local;
  session_->editing().hold("Drag");
  for (int i = 0; i < 5; ++i) {
    t.translation.x += 1.0f;
    session_->setNodeTransform(id, t);
  }
  EXPECT_TRUE(!fs::exists(root_));
  session_->editing().commit();
  EXPECT_EQ(killAndRecover().edits, 1);
}

TEST_F(Recovery, AnIncompleteLastLineIsIgnored) {
  act("light.add disk");
  const uint64_t before = documentHash(session_->document());
  act("light.add sphere");
  const fs::path file = journal();
  session_.reset();
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const size_t lastLine = text.rfind('\n', text.size() - 2) + 1;
  for (size_t length = lastLine; length < text.size(); length += 97) {
    fs::resize_file(file, length);
    Recovered r = recover(file.parent_path());
    EXPECT_EQ(r.edits, 1);
    EXPECT_EQ(documentHash(r.document), before);
    r = {};
    std::ofstream(file, std::ios::binary) << text;
  }
}

TEST_F(Recovery, ARunningProcessIsNotOffered) {
  act("light.add disk");
  EXPECT_TRUE(findRecoverable(root_).empty());
  EXPECT_THROW(recover(session_->crashRecovery().journal()->folder()), InputError);
  EXPECT_THROW(discard(session_->crashRecovery().journal()->folder()), InputError);
}

TEST_F(Recovery, ASessionThatEndsRemovesItsJournal) {
  act("light.add disk");
  session_->crashRecovery().close();
  EXPECT_TRUE(fs::is_empty(root_));
}

TEST_F(Recovery, OpeningAnotherLevelEndsTheJournal) {
  act("light.add disk");
  open(*session_, level_);
  EXPECT_TRUE(fs::is_empty(root_));
}

TEST_F(Recovery, SavedWorkIsNotOffered) {
  act("light.add disk");
  act("file.save");
  session_.reset();
  EXPECT_TRUE(findRecoverable(root_).empty());
}

TEST_F(Recovery, ContinuesAfterASaveToTheOpenedFile) {
  act("light.add disk");
  act("select.name floor");
  act("edit.delete");
  act("file.save");
  act("light.add sphere");
  const Recovered r = killAndRecover();
  EXPECT_EQ(r.edits, 1);
  EXPECT_TRUE(r.hasLevel);
}

TEST_F(Recovery, ContinuesAfterASaveBeforeTheFirstEdit) {
  act("file.save");
  act("light.add sphere");
  EXPECT_TRUE(killAndRecover().hasLevel);
}

TEST_F(Recovery, RefusesALevelThatHasBeenChangedSince) {
  act("light.add sphere");
  const fs::path state = session_->crashRecovery().journal()->folder();
  session_.reset();
  std::ofstream(level_, std::ios::app) << ' ';
  try {
    recover(state);
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("has been changed since"), std::string::npos);
  }
}

TEST_F(Recovery, AnAutosaveNeedsNoOtherFile) {
  act("light.add sphere");
  act("recovery.autosave");
  act("edit.rename after");
  const fs::path state = session_->crashRecovery().journal()->folder();
  EXPECT_TRUE(fs::exists(level_));
  fs::remove(level_);
  fs::remove(folder_.path() / "level.bin");
  const Recovered r = killAndRecover();
  EXPECT_EQ(r.edits, 2);
  EXPECT_EQ(r.labels.size(), 1u);  // the autosave restarted the journal
  const LoadedScene autosave = loadGltf(state / "autosave.glb");
  EXPECT_EQ(autosave.scene.nodes.size(), 3u);
}

TEST_F(Recovery, TheActionRecoversTheWorkAndContinuesTheJournal) {
  act("light.add sphere");
  act("edit.rename mine");
  const Document was = session_->document();
  session_.reset();
  session_ = sessionWith(root_, 8);
  open(*session_, level_);
  act("recovery.recover");
  EXPECT_EQ(documentHash(session_->document()), documentHash(was));
  EXPECT_TRUE(session_->modified());
  EXPECT_TRUE(session_->crashRecovery().found().empty());
  act("select.name mine");
  act("edit.rename again");
  session_->renderFrame();
  const Recovered r = killAndRecover();
  EXPECT_EQ(r.edits, 3);
}

TEST_F(Recovery, RecoveredWorkCanBeSaved) {
  act("light.add sphere");
  session_.reset();
  session_ = sessionWith(root_, 8);
  act("recovery.recover");
  act("file.save");
  EXPECT_FALSE(session_->modified());
  EXPECT_EQ(loadGltf(level_).scene.nodes.size(), 3u);
}

TEST_F(Recovery, KeepsTheWorkOfThisSession) {
  act("light.add sphere");
  session_.reset();
  session_ = sessionWith(root_, 8);
  open(*session_, level_);
  act("light.add disk");
  EXPECT_FALSE(session_->runAction("recovery.recover"));
  EXPECT_EQ(session_->document().scene.nodes.size(), 3u);
}

TEST_F(Recovery, DiscardDeletesIt) {
  act("light.add sphere");
  session_.reset();
  session_ = sessionWith(root_, 8);
  act("recovery.discard");
  EXPECT_TRUE(fs::is_empty(root_));
  EXPECT_FALSE(session_->runAction("recovery.discard") &&
               !session_->crashRecovery().found().empty());
}

TEST_F(Recovery, KeepsObjectsPastedFromAnotherLevel) {
  Scene other;
  const int red = addMaterial(other, vec3(0.6f, 0.1f, 0.1f));
  auto image = std::make_shared<Image8>(3, 2);
  image->pixels[5] = 17;
  other.textures.push_back({"bricks", image, Wrap::clamp, Wrap::mirror, true, false});
  other.materials[static_cast<size_t>(red)].baseColorTexture.texture = 0;
  const NodeId box = addMesh(other, boxMesh(vec3(1.0f), red));
  session_->setClipboard(clip(other, {box}));
  session_->open(loadGltf(level_).scene, level_, {});
  act("edit.paste");
  const Mesh was = *session_->document().scene.meshes.back();
  const Recovered r = killAndRecover();
  const Scene& s = r.document.scene;
  ASSERT_EQ(s.textures.size(), 1u);
  EXPECT_EQ(s.textures[0].image->pixels, image->pixels);
  EXPECT_EQ(s.textures[0].wrapT, Wrap::mirror);
  EXPECT_EQ(s.meshes.back()->primitives[0].positions, was.primitives[0].positions);
  EXPECT_EQ(s.meshes.back()->primitives[0].indices, was.primitives[0].indices);
}

TEST_F(Recovery, KeepsProfilesWithAnyBytes) {
  const char* text =
      "IESNA:LM-63-1995\n[LUMINAIRE] Stra\xdf"
      "e\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0\n1 1 50\n0 45 90\n0\n100 60 10\n";
  act("light.add spot");
  const Node& n = *session_->document().scene.find(session_->document().active());
  PunctualLight light = *n.punctual;
  light.profile = parseIes(text, "stra\u00dfe.ies");
  session_->setPunctualLight(n.id, light);
  const Recovered r = killAndRecover();
  EXPECT_EQ(r.document.scene.nodes.back().punctual->profile->text, text);
}

TEST_F(Recovery, ADamagedJournalIsRefused) {
  act("light.add sphere");
  const fs::path file = journal();
  session_.reset();
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  for (size_t at = 0; at < text.size(); at += 41) {
    std::string damaged = text;
    damaged[at] = damaged[at] == '1' ? '9' : '1';
    std::ofstream(file, std::ios::binary) << damaged;
    try {
      recover(file.parent_path());  // some damage has no effect or only causes a warning
    } catch (const InputError&) {
    }
  }
  std::ofstream(file, std::ios::binary) << "{}\n{}\n";
  EXPECT_THROW(recover(file.parent_path()), InputError);
}

}  // namespace

}  // namespace lamplighter::test
