// Measurements of the frames of a session: their cost, the latency of edits, and the error of the
// picture.
#pragma once

#include "editor/error_meter/error_meter.h"
#include "editor/latency/edit_latency.h"
#include "editor/timeline/timeline.h"

namespace lamplighter {

struct FrameWatch {
  ErrorMeter meter;
  EditLatency latency;
  Timeline timeline;
  RenderSettings shown;  // of the last frame
};

}  // namespace lamplighter
