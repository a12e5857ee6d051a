// Statistics of edit latencies for the reports of replays.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "editor/latency/edit_latency.h"

namespace lamplighter {

// "3 edits seen: 95% in 4 frames (median), 12 at most". Counts frames only, so that the text is the
// same on every machine. "": nothing was measured.
std::string latencySummary(const EditLatency& latency);
// Every edit with its frames and milliseconds.
nlohmann::ordered_json latencyJson(const EditLatency& latency);

}  // namespace lamplighter
