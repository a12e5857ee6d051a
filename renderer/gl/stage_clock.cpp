#include "renderer/gl/stage_clock.h"

#include <utility>

namespace lamplighter::gl {
namespace {

// Frames that are measured at a time; while the GPU is further behind, no new ones are.
constexpr size_t kMostFrames = 8;

}  // namespace

void StageClock::mark(size_t stage) {
  if (free_.empty()) free_.push_back(QueryObject::make(GL_TIMESTAMP));
  frames_.back().push_back({stage, std::move(free_.back())});
  free_.pop_back();
  glQueryCounter(frames_.back().back().query.name(), GL_TIMESTAMP);
}

void StageClock::begin() {
  collect();
  if (frames_.size() >= kMostFrames) {
    for (Mark& m : frames_.back()) free_.push_back(std::move(m.query));
    frames_.pop_back();
  }
  frames_.emplace_back();
  mark(0);
}

void StageClock::end(size_t stage) {
  if (!frames_.empty()) mark(stage);
}

// Stamps are taken in order, so the last one of a frame is the last to be known.
void StageClock::collect() {
  while (!frames_.empty()) {
    std::vector<Mark>& marks = frames_.front();
    GLuint isAvailable = GL_FALSE;
    glGetQueryObjectuiv(marks.back().query.name(), GL_QUERY_RESULT_AVAILABLE, &isAvailable);
    if (isAvailable == GL_FALSE) return;
    seconds_.clear();
    GLuint64 last = 0;
    for (size_t i = 0; i < marks.size(); ++i) {
      GLuint64 now = 0;
      glGetQueryObjectui64v(marks[i].query.name(), GL_QUERY_RESULT, &now);
      if (i > 0) {
        if (seconds_.size() <= marks[i].stage) seconds_.resize(marks[i].stage + 1, 0.0);
        if (now > last) seconds_[marks[i].stage] += 1e-9 * static_cast<double>(now - last);
      }
      last = now;
      free_.push_back(std::move(marks[i].query));
    }
    frames_.pop_front();
  }
}

}  // namespace lamplighter::gl
