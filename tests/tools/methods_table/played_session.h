// A session in which the recording is played with a method, paced as in the editor's window.
#pragma once

#include <string>

#include "editor/convergence/convergence_meter.h"
#include "editor/session/session.h"
#include "tests/support/level_recording.h"

namespace lamplighter {

struct PlayedSession {
  static constexpr int kWidth = 320, kHeight = 240;  // of pictures
  static constexpr int kBounces = 5;
  static constexpr int kBlock = 4;  // side of the blocks whose means are compared [pixels]

  // On the cpu backend, without a level. `method`: with parameters, "many_lights,vpls=100".
  explicit PlayedSession(const std::string& method);
  // Brings the session to a state of the recording, by the edits of a user.
  void show(const test::LevelRecording& recording, const test::LevelRecording::State& state);

  Session session;
  ConvergenceMeter meter;
};

}  // namespace lamplighter
