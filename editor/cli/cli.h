// The command line. Its interface is stable because other programs call it. main() passes in
// everything that needs OpenGL or a window, because this layer links neither.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "renderer/methods/gi_method.h"

namespace lamplighter {

struct EditorOptions {
  std::string scene;   // "": the default scene
  std::string record;  // file to record to; "": none
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
  bool frameClock = false;  // times count frames; costs of frames are not measured
  std::string method;       // "": the method of the recording
  // Values of parameters that replace the recorded ones: "name=value". Baselines are still
  // compared; the hash of the document ignores these values.
  std::vector<std::string> assignments;
  std::string backend = "auto";
  int threads = 0;  // 0: all cores
  // Other runs that are compared with the first: "threads=N", "backend=cpu" or "backend=gl".
  std::vector<std::string> against;
};

struct Frontend {
  // kind: "cpu", "gl" or "auto" (chooses the faster one by a short measurement). Throws InputError
  // if gl is requested and there is no OpenGL context.
  std::function<std::unique_ptr<Backend>(const std::string& kind)> makeBackend;
  std::function<int(const EditorOptions&)> runEditor;  // exit code
  std::function<int(const ReplayOptions&)> runReplay;  // exit code
  Stopwatch stopwatch;                                 // for the timings in --stats
  // Called at most once, by a command that can stop cleanly. After that, Ctrl+C does not end the
  // program; the returned function reports true instead.
  std::function<std::function<bool()>()> catchInterrupts;
  std::function<int64_t()> unixTime;  // seconds since 1970, for journals
  int process = 0;                    // process id
};

// Returns the exit code: 0 success, 1 a check failed, 2 wrong usage, bad input or any exception
// (with one line on standard error).
int runCommandLine(int argc, const char* const* argv, const Frontend& frontend);

}  // namespace lamplighter
