// The stages of a frame of many_lights.
#pragma once

#include "renderer/base/statistics.h"

namespace lamplighter {

inline constexpr StageSpec kLightSamplesStage{
    "light samples", "Light samples",
    "Tracing light paths and choosing the light samples for the view."};
inline constexpr StageSpec kVisibilityStage{
    "visibility", "Visibility",
    "Choosing the light samples to update, and testing which patches they reach.",
    StageWork::updates};
inline constexpr StageSpec kShadowMapsStage{
    "shadow maps", "Shadow maps",
    "Rendering shadow maps, and choosing the maps and proxies for the view.", StageWork::updates};
inline constexpr StageSpec kFinerMapsStage{
    "finer maps", "Finer maps", "Rendering finer shadow maps once nothing else is pending."};
inline constexpr StageSpec kLightMapsStage{
    "light maps", "Light maps", "Adding light samples to the light maps and subtracting them.",
    StageWork::updates};
inline constexpr StageSpec kTransferStage{
    "transfer", "Transfer", "Computing and lighting meshes with precomputed radiance transfer.",
    StageWork::updates};
inline constexpr StageSpec kGBufferStage{"g-buffer", "G-buffer",
                                         "Finding the surface of each pixel."};
inline constexpr StageSpec kLightSumsStage{"light sums", "Light sums",
                                           "Summing the light samples at each pixel."};
inline constexpr StageSpec kCompositionStage{
    "composition", "Composition", "Combining irradiance with materials, emission and the sky."};
inline constexpr StageSpec kAntialiasingStage{"antialiasing", "Antialiasing",
                                              "Averaging the pictures of a settled view."};
inline constexpr StageSpec kSharesStage{
    "light shares", "Light shares",
    "Finding what each light adds to a settled picture, antialiased, and adding it up."};
inline constexpr StageSpec kBiasCompensationStage{
    "bias_compensation", "Bias compensation",
    "Tracing the light that the clamp removes near surfaces."};
inline constexpr StageSpec kMeshesStage{"meshes", "Light on surfaces",
                                        "Finding bounced light on the surfaces, and showing it.",
                                        StageWork::surfaces};
inline constexpr StageSpec kRefinementStage{
    "refinement", "Refinement", "Adding batches of light samples to a settled picture."};

// In the order of a frame.
inline constexpr StageSpec kManyLightsStages[] = {
    kLightSamplesStage, kVisibilityStage,   kShadowMapsStage, kFinerMapsStage,
    kLightMapsStage,    kTransferStage,     kGBufferStage,    kLightSumsStage,
    kCompositionStage,  kAntialiasingStage, kSharesStage,     kBiasCompensationStage,
    kMeshesStage,       kRefinementStage};

}  // namespace lamplighter
