// Brings a session to a state of the recording, by the edits of a user.
#pragma once

#include "editor/session/session.h"
#include "tests/support/level_recording.h"

namespace lamplighter {

void show(Session& session, const test::LevelRecording& recording,
          const test::LevelRecording::State& state);

}  // namespace lamplighter
