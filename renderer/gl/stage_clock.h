// Time of the GPU for each stage of a frame, known some frames later.
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "renderer/gl/objects.h"

namespace lamplighter::gl {

// Time stamps between the commands of stages (GL_TIMESTAMP). Never waits for the GPU.
class StageClock {
 public:
  void begin();            // of a frame
  void end(size_t stage);  // of the commands since the last call
  // Seconds of the stage in the newest frame that the GPU has finished; 0: it had no such stage.
  double seconds(size_t stage) const { return stage < seconds_.size() ? seconds_[stage] : 0.0; }

 private:
  struct Mark {
    size_t stage = 0;  // the stage that ends here; the first mark of a frame ends none
    QueryObject query;
  };
  void mark(size_t stage);
  void collect();

  std::deque<std::vector<Mark>> frames_;  // the last one is still being recorded
  std::vector<QueryObject> free_;
  std::vector<double> seconds_;  // by stage
};

}  // namespace lamplighter::gl
