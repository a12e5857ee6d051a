// What a session keeps about working with lights that is no part of the document.
#pragma once

#include "editor/lights/light_table.h"

namespace lamplighter {

class Session;

// Keeps figures from frame to frame, since going through every patch takes a while on large levels.
class LightTable {
 public:
  // Figures are looked up anew every so many frames, and when the picture settles.
  static constexpr uint32_t kFrames = 20;
  std::vector<LightRow> rows(const Session& session, LightUnit unit);

 private:
  bool known_ = false, wasSettled_ = false;
  uint32_t frame_ = 0;
  uint64_t scene_ = 0;         // revision
  double lightSeconds_ = 0.0;  // smoothed, of frames that had something to do
  std::map<NodeId, LightFigures> figures_;
  std::map<NodeId, double> shares_;
};

struct LightingState {
  LightUnit unit = LightUnit::lumens;  // in which strength is shown and typed
  bool showsTable = false;
  LightTable table;
  // A lamp at the eye for dark scenes, in no document and no file [cd]; 0: off.
  float workLight = 0.0f;
};

}  // namespace lamplighter
