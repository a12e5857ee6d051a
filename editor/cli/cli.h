// The command line (a contract: other programs call it). What needs OpenGL or a window is handed in
// by main, since this layer links neither.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "renderer/methods/gi_method.h"

namespace lamplighter {

struct EditorOptions {
  std::string scene;   // "": the default scene
  std::string record;  // file to record to, "": none
  std::string backend = "auto";
  std::string journal;  // folder; "": in the user's state folder
};

struct ReplayOptions {
  std::string recording;
  bool headless = false;
  std::string outputFolder;  // "": none
  std::string report;        // JSON file, "": none
  bool check = false;
  bool updateBaselines = false;
  bool frameClock = false;  // times count frames, and what a frame was spent on is not measured
  std::string method;       // "": as recorded
  std::string backend = "auto";
  int threads = 0;  // 0: all cores
  // Runs to compare with the first: "threads=N", "backend=cpu" or "backend=gl".
  std::vector<std::string> against;
};

struct Frontend {
  // kind: "cpu", "gl" or "auto" (the faster, by a short measurement). Throws InputError when gl is
  // asked for and there is no context.
  std::function<std::unique_ptr<Backend>(const std::string& kind)> makeBackend;
  std::function<int(const EditorOptions&)> runEditor;  // exit code
  std::function<int(const ReplayOptions&)> runReplay;  // exit code
  Stopwatch stopwatch;                                 // for the timings in --stats
  // Called once by a command that can stop in good order; from then on Ctrl+C only makes what is
  // returned answer true.
  std::function<std::function<bool()>()> catchInterrupts;
  std::function<int64_t()> unixTime;  // seconds since 1970, for journals
  int process = 0;                    // its number
};

// Exit code: 0 good, 1 a check failed, 2 bad use or bad input (one line on standard error).
int runCommandLine(int argc, const char* const* argv, const Frontend& frontend);

}  // namespace lamplighter
