// Identifies the state of an object, so that caches can detect changes.
#pragma once

#include <memory>

namespace lamplighter {

// Equal revisions mean that nothing changed, even if objects were created, copied or destroyed
// meanwhile. Each state has its own token; its address is not reused while any Revision refers to
// it.
class Revision {
 public:
  void advance() { token_ = std::make_shared<char>(); }
  bool operator==(const Revision&) const = default;

 private:
  std::shared_ptr<const char> token_;
};

}  // namespace lamplighter
