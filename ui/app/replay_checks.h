// Compares the checkpoints of a replay with the baselines beside the recording, with earlier
// checkpoints of the same run that must look the same, and with the checkpoints of another run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "editor/cli/cli.h"
#include "editor/input/recording.h"
#include "renderer/image/image.h"

namespace lamplighter {

// One run of a recording.
struct ReplayRun {
  std::string label;           // "" for the first run, otherwise its options: "threads=1"
  bool hasSameBackend = true;  // the same backend as the first run
  bool isOnCpu = true;
};

class ReplayChecks {
 public:
  // Both arguments must outlive this object.
  ReplayChecks(const ReplayOptions& options, const Recording& recording)
      : options_(options), recording_(recording) {}

  void begin(const ReplayRun& run);
  // Checks a checkpoint. Throws InputError if a picture cannot be read or written.
  void take(const Checkpoint& checkpoint, const std::string& document, Image8 picture);
  // For --update-baselines: makes this picture the baseline.
  void writeBaseline(const Checkpoint& checkpoint, const Image8& picture) const;

  // The path for a checkpoint's picture: in the output folder, or in out/replay if a check failed
  // and no folder was given.
  std::filesystem::path outputOf(const Checkpoint& checkpoint, const std::string& ending) const;

  int passed() const { return passed_; }
  int failed() const { return failed_; }
  const nlohmann::ordered_json& report() const { return report_; }

 private:
  struct Seen {
    std::string name, document;
    Image8 picture;
  };
  const Seen* find(const std::vector<Seen>& seen, const std::string& name) const;
  std::string documentProblem(const Checkpoint& checkpoint, const std::string& document) const;
  std::string baselineProblem(const Checkpoint& checkpoint, const Image8& picture) const;
  std::string sameAsProblem(const Checkpoint& checkpoint, const Image8& picture) const;
  std::string firstRunProblem(const Checkpoint& checkpoint, const std::string& document,
                              const Image8& picture) const;
  std::string writeHeatMap(const Checkpoint& checkpoint, const Image8& picture,
                           const Image8& expected) const;

  const ReplayOptions& options_;
  const Recording& recording_;
  ReplayRun run_;
  std::vector<Seen> first_, now_;  // of the first run and of the current run
  int passed_ = 0, failed_ = 0;
  nlohmann::ordered_json report_ = nlohmann::ordered_json::array();
};

}  // namespace lamplighter
