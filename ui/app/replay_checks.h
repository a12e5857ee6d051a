// What a replay's checkpoints are compared with: the baselines beside the recording, earlier
// checkpoints of the same run that must look the same, and the checkpoints of another run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "editor/cli/cli.h"
#include "editor/input/recording.h"
#include "renderer/image/image.h"

namespace lamplighter {

// One run of a recording, as its checkpoints are compared.
struct ReplayRun {
  std::string label;           // "" for the first, else how it is played: "threads=1"
  bool hasSameBackend = true;  // as the first
  bool isOnCpu = true;
};

class ReplayChecks {
 public:
  // Both must outlive this.
  ReplayChecks(const ReplayOptions& options, const Recording& recording)
      : options_(options), recording_(recording) {}

  void begin(const ReplayRun& run);
  // A checkpoint that was reached. Throws InputError when a picture cannot be read or written.
  void take(const Checkpoint& checkpoint, const std::string& document, Image8 picture);
  // As --update-baselines: the baseline becomes this picture.
  void writeBaseline(const Checkpoint& checkpoint, const Image8& picture) const;

  // Where a checkpoint's picture goes: the output folder, or out/replay when a check fails and
  // nobody named a folder.
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
  std::vector<Seen> first_, now_;  // of the first run, and of this one
  int passed_ = 0, failed_ = 0;
  nlohmann::ordered_json report_ = nlohmann::ordered_json::array();
};

}  // namespace lamplighter
