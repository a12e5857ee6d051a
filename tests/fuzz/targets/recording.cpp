// Recordings give an InputError, or events that stay the same when written and read again.
#include "editor/input/recording.h"

#include "renderer/base/error.h"
#include "tests/fuzz/targets/scratch.h"

using namespace lamplighter;

namespace {

std::string textOf(const Recording& recording) {
  std::string text = headerText(recording.header) + '\n';
  for (const RecordingLine& l : recording.lines) text += lineText(l) + '\n';
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  Recording recording;
  try {
    recording = readRecording(fuzz::scratch().write("r.jsonl", fuzz::textOf(data, size)));
  } catch (const InputError&) {
    return 0;
  }
  const std::string text = textOf(recording);
  const Recording again = readRecording(fuzz::scratch().write("r.jsonl", text));
  if (textOf(again) != text) fuzz::broken("the same lines again");
  return 0;
}
