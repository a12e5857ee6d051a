// Statistics and stages that methods share, and how a method returns its own statistics.
#pragma once

#include "renderer/methods/gi_method.h"

namespace lamplighter {

const StatisticTable<GiStats>& commonStatistics();

// The stage of methods that trace paths for each pixel.
inline constexpr StageSpec kPathsStage{"paths", "Paths", "Tracing paths for each pixel."};

// The statistics of a frame as GiOutput has them.
template <std::derived_from<GiStats> Stats>
GiStats published(const Stats& stats, const StatisticTable<Stats>& table) {
  GiStats out = stats;
  out.declared = table.of(stats);
  return out;
}

}  // namespace lamplighter
