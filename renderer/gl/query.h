// Measurements that the GPU makes while it draws, read when they are ready, frames later.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "renderer/gl/objects.h"

namespace lamplighter::gl {

// One measurement of a kind, repeated: GL_TIME_ELAPSED [ns] (means nothing on llvmpipe, which draws
// later than it counts), GL_SAMPLES_PASSED, GL_ANY_SAMPLES_PASSED, GL_PRIMITIVES_GENERATED. Only
// one of a kind can be active at a time. Never waits for the GPU.
class Query {
 public:
  explicit Query(GLenum kind) : kind_(kind) {}

  // Measures the commands of its lifetime.
  class Scope {
   public:
    explicit Scope(Query& query) : query_(query) { query_.begin(); }
    ~Scope() { query_.end(); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Query& query_;
  };

  // Whether a measurement has finished since the last call of result().
  bool ready();
  // The newest finished measurement; 0 before the first one.
  uint64_t result();

 private:
  void begin();
  void end();
  void collect();

  GLenum kind_;
  std::deque<QueryObject> pending_;  // in the order of measurement; the last one may be active
  std::vector<QueryObject> free_;
  uint64_t result_ = 0;
  bool isNew_ = false, isActive_ = false;
};

}  // namespace lamplighter::gl
