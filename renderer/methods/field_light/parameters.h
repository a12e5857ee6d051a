// Parameters and statistics of methods whose bounced light is in a light field
// (renderer/light_field).
#pragma once

#include "renderer/base/parameter_table.h"
#include "renderer/base/statistics.h"
#include "renderer/light_field/light_field.h"

namespace lamplighter {

struct LightFieldParameters {
  float fieldTexel = 0.1f;  // [m]
  int fieldDivisions = 16;
  FieldSightChoice fieldSight = FieldSightChoice::automatic;
  float fieldCell = 1.0f;  // [texels]
  bool fieldLamps = false;
  int fieldSets = 4;
  int fieldMemory = 128;  // MiB
  bool operator==(const LightFieldParameters&) const = default;

  LightFieldOptions field(int bounces, int seed) const {
    return {fieldTexel,
            fieldDivisions,
            fieldSight,
            fieldCell,
            fieldLamps,
            fieldSets,
            static_cast<size_t>(fieldMemory) << 20,
            bounces,
            true,
            bounces > 0,
            static_cast<uint32_t>(seed)};
  }
};
const ParameterTable<LightFieldParameters>& lightFieldParameters();

struct LightFieldStats {
  int fieldTexels = 0, fieldDirections = 0;
  float fieldTexelSide = 0.0f;  // [m]
  uint64_t fieldSamples = 0, fieldCrossings = 0, fieldRays = 0, fieldBytes = 0;
  float fieldPrepared = 100.0f;  // percent

  void take(const LightField& light);
};
const StatisticTable<LightFieldStats>& lightFieldStatistics();

}  // namespace lamplighter
