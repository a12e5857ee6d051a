#include "renderer/gl/query.h"

namespace lamplighter::gl {

void Query::begin() {
  collect();
  if (free_.empty()) free_.push_back(QueryObject::make(kind_));
  pending_.push_back(std::move(free_.back()));
  free_.pop_back();
  glBeginQuery(kind_, pending_.back().name());
  isActive_ = true;
}

void Query::end() {
  glEndQuery(kind_);
  isActive_ = false;
}

void Query::collect() {
  while (pending_.size() > (isActive_ ? 1 : 0)) {
    GLuint isAvailable = GL_FALSE;
    const GLuint name = pending_.front().name();
    glGetQueryObjectuiv(name, GL_QUERY_RESULT_AVAILABLE, &isAvailable);
    if (isAvailable == GL_FALSE) return;
    glGetQueryObjectui64v(name, GL_QUERY_RESULT, &result_);
    isNew_ = true;
    free_.push_back(std::move(pending_.front()));
    pending_.pop_front();
  }
}

bool Query::ready() {
  collect();
  return isNew_;
}

uint64_t Query::result() {
  collect();
  isNew_ = false;
  return result_;
}

}  // namespace lamplighter::gl
