// The stages of bounced light by imperfect shadow maps.
#pragma once

#include "renderer/base/statistics.h"

namespace lamplighter {

inline constexpr StageSpec kReflectiveMapStage{
    "reflective map", "Reflective map", "Tracing the light paths among which samples are chosen."};
inline constexpr StageSpec kImportanceStage{
    "importance", "Importance", "Finding what potential samples bring to the view, and choosing."};
inline constexpr StageSpec kOccluderPointsStage{"occluder points", "Occluder points",
                                                "Placing the points that shadow maps show."};
inline constexpr StageSpec kInterleavedStage{
    "imperfect maps", "Imperfect maps",
    "Drawing imperfect shadow maps, summing their lights at pixels, and the blur."};

// In the order of a frame.
inline constexpr StageSpec kImperfectStages[] = {kReflectiveMapStage, kImportanceStage,
                                                 kOccluderPointsStage, kInterleavedStage};

}  // namespace lamplighter
