// What is kept about the frames of a session: what they cost, how soon edits are seen, and how far
// the picture is from the truth.
#pragma once

#include "editor/error_meter/error_meter.h"
#include "editor/latency/edit_latency.h"
#include "editor/timeline/timeline.h"

namespace lamplighter {

struct FrameWatch {
  ErrorMeter meter;
  EditLatency latency;
  Timeline timeline;
  RenderSettings shown;  // by which the last frame was rendered
};

}  // namespace lamplighter
