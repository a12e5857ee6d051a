// Statistics and stages that several methods use, and conversion of the statistics of a method for
// GiOutput.
#pragma once

#include "renderer/methods/gi_method.h"

namespace lamplighter {

const StatisticTable<GiStats>& commonStatistics();

// The stage of methods that trace paths per pixel.
inline constexpr StageSpec kPathsStage{"paths", "Paths", "Tracing paths for each pixel."};

// Converts the statistics of a frame for GiOutput.
template <std::derived_from<GiStats> Stats>
GiStats published(const Stats& stats, const StatisticTable<Stats>& table) {
  GiStats out = stats;
  out.declared = table.of(stats);
  return out;
}

}  // namespace lamplighter
