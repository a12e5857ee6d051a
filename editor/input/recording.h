// Recordings of input: one JSON object a line, short, so that they can be read, compared and cut by
// hand. The first line is the header; then events and checkpoints by frame, in order:
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
// A checkpoint waits until the picture is settled; the clock stands still meanwhile, so that what
// follows means the same on any machine. Its picture, at half the size, is compared with
// STEM.CHECK.png beside the recording unless "image" is false; "max" and "mean" (of 8-bit
// differences) loosen that on the gl backend. "sameAs" names an earlier checkpoint whose picture has
// the same bits, as after an undo.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <variant>
#include <vector>

#include "editor/document/document.h"
#include "editor/input/event.h"

namespace lamplighter {

struct RecordingHeader {
  std::string scene;      // relative to the recording's folder; "": no scene
  std::string sceneHash;  // of the scene file's bytes, as hex; "": not checked
  // Folder with journals that killed processes have left, beside the recording. The replay finds
  // copies of them, and keeps a journal itself; "": neither.
  std::string left;
  int width = 1280, height = 720;  // of the window, pixels
  int framesPerSecond = 60;        // the fixed time step
  RenderSettings render;
};

struct Checkpoint {
  std::string name;
  std::string document;  // hash as hex; "": not compared
  bool image = true;     // the picture is compared with a baseline
  std::string sameAs;    // an earlier checkpoint with the same picture; "": none
  // Largest (one pixel in a thousand apart) and mean difference allowed, of 255, on the gl backend.
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
  std::filesystem::path leftPath() const;   // likewise
  std::filesystem::path baselineOf(const Checkpoint& checkpoint) const;

 private:
  std::filesystem::path beside(const std::string& name) const;
};

// Throws InputError "FILE:LINE: what is wrong; what to do".
Recording readRecording(const std::filesystem::path& path);
// Atomic; throws InputError.
void writeRecording(const Recording& recording);

std::string headerText(const RecordingHeader& header);  // one line, without its end
std::string lineText(const RecordingLine& line);

std::string hashText(uint64_t hash);  // 16 hex digits
// Of a file's bytes; throws InputError when it cannot be read.
uint64_t fileHash(const std::filesystem::path& path);

}  // namespace lamplighter
