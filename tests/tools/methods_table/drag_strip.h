// Every frame of a drag as one picture, to look for flicker and for jumps when it settles.
#pragma once

#include <filesystem>
#include <string>

#include "tests/support/level_recording.h"

namespace lamplighter {

// The frames of "drag a light" of the recording, paced as in the editor's window, then the frame
// after the drag and the settled picture, as tiles. Prints the change from frame to frame, as
// relRMSE of means of 4 × 4 pixels (its median, the largest one, that after the drag, and from
// there to the settled picture), and the mean time of each stage during the drag.
void writeDragStrip(const std::string& level, const std::string& method,
                    const test::LevelRecording& recording, const std::filesystem::path& file);

}  // namespace lamplighter
