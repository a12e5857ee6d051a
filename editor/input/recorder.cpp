#include "editor/input/recorder.h"

#include "renderer/base/error.h"

namespace lamplighter {

Recorder::Recorder(std::filesystem::path path, const RecordingHeader& header)
    : path_(std::move(path)), out_(path_) {
  out_ << headerText(header) << '\n' << std::flush;
  if (!out_)
    throw InputError(path_.string(), "cannot be written", "check the folder and the space left");
}

void Recorder::frame(const std::vector<InputEvent>& events) {
  for (size_t i = 0; i < events.size(); ++i) {
    const bool overtaken = events[i].kind == EventKind::pointer && i + 1 < events.size() &&
                           events[i + 1].kind == EventKind::pointer;
    if (!overtaken) out_ << lineText({frame_, events[i]}) << '\n';
  }
  if (!events.empty()) out_ << std::flush;
  ++frame_;
  if (!out_)
    throw InputError(path_.string(), "cannot be written any more, so the recording has ended",
                     "free some space and record again");
}

void Recorder::checkpoint(const Checkpoint& checkpoint) {
  out_ << lineText({frame_, checkpoint}) << '\n' << std::flush;
}

}  // namespace lamplighter
