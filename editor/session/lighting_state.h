// State of a session for working with lights that is not part of the document.
#pragma once

#include "editor/lights/light_table.h"

namespace lamplighter {

class Session;

// Keeps the figures of lights between frames, because visiting every patch is slow on large levels.
class LightTable {
 public:
  // Number of frames between updates of the figures, which are also updated when the picture has
  // settled.
  static constexpr uint32_t kFrames = 20;
  std::vector<LightRow> rows(const Session& session, LightUnit unit);

 private:
  bool known_ = false, wasSettled_ = false;
  uint32_t frame_ = 0;
  uint64_t scene_ = 0;         // revision
  double lightSeconds_ = 0.0;  // smoothed time of frames that were not settled
  std::map<NodeId, LightFigures> figures_;
  std::map<NodeId, double> shares_;
};

struct LightingState {
  LightUnit unit = LightUnit::lumens;  // in which intensities are shown and typed
  bool showsTable = false;
  LightTable table;
  // Intensity of a light at the eye for dark scenes, not part of the document [cd]; 0: off.
  float workLight = 0.0f;
};

}  // namespace lamplighter
