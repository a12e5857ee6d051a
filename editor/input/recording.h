// Recordings of input: one short JSON object per line, easy to read, compare and edit by hand. The
// first line is the header. Events and checkpoints follow, ordered by frame:
//
//   {"lamplighter":1,"scene":"../../assets/scenes/default.gltf","window":[960,600],"fps":60, …}
//   {"f":3,"action":"light.add rectangle"}
//   {"f":5,"pointer":[320,200],"on":"viewport"}
//   {"f":5,"button":0,"down":true}
//   {"f":9,"wheel":[0,1]}
//   {"f":9,"key":"w","down":true}
//   {"f":9,"text":"512"}
//   {"f":20,"check":"placed","document":"0123456789abcdef"}
//
// A checkpoint waits until the picture is settled. The clock stands still meanwhile, so that the
// following events have the same effect on any machine. Its picture, at half size, is compared with
// the baseline STEM.CHECK.png beside the recording unless "image" is false. "max" and "mean" (of
// 8-bit differences) set the tolerance for the gl backend. "sameAs" names an earlier checkpoint
// whose picture must have the same bits, for example after an undo.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "editor/document/document.h"
#include "editor/input/event.h"

namespace lamplighter {

struct RecordingHeader {
  std::string scene;      // relative to the recording's folder; "": no scene
  std::string sceneHash;  // hash of the scene file's bytes, as hex; "": not checked
  // Folder beside the recording with journals of killed processes. The replay works on copies of
  // them and keeps its own journal. "": neither.
  std::string left;
  int width = 1280, height = 720;  // of the window, pixels
  int framesPerSecond = 60;        // the fixed time step
  RenderSettings render;
};

struct Checkpoint {
  std::string name;
  std::string document;  // hash as hex; "": not compared
  bool image = true;     // the picture is compared with a baseline
  std::string sameAs;    // earlier checkpoint with the same picture; "": none
  // Tolerances on the gl backend, of 255: the largest difference (the worst 0.1% of the pixels are
  // ignored) and the mean difference.
  float max = 16.0f;
  float mean = 0.5f;
  bool operator==(const Checkpoint&) const = default;
};

struct RecordingLine {
  uint32_t frame = 0;
  std::variant<InputEvent, Checkpoint> what;
};

struct Recording {
  std::filesystem::path path;
  RecordingHeader header;
  std::vector<RecordingLine> lines;

  std::filesystem::path scenePath() const;  // empty when there is none
  std::filesystem::path leftPath() const;   // same for `left`
  std::filesystem::path baselineOf(const Checkpoint& checkpoint) const;

 private:
  std::filesystem::path beside(const std::string& name) const;
};

// Throws InputError with the text "FILE:LINE: problem; remedy".
Recording readRecording(const std::filesystem::path& path);
// Atomic; throws InputError.
void writeRecording(const Recording& recording);

std::string headerText(const RecordingHeader& header);  // one line without line break
std::string lineText(const RecordingLine& line);

std::string hashText(uint64_t hash);  // 16 hex digits
// Hash of a file's bytes. Throws InputError if the file cannot be read.
uint64_t fileHash(const std::filesystem::path& path);

}  // namespace lamplighter
