// Which state something is in, for those who keep copies of it.
#pragma once

#include <memory>

namespace lamplighter {

// Equal ones mean that nothing changed, whatever was made, copied or destroyed in between: each
// state has a token of its own, whose address stays taken while anyone remembers it.
class Revision {
 public:
  void advance() { token_ = std::make_shared<char>(); }
  bool operator==(const Revision&) const = default;

 private:
  std::shared_ptr<const char> token_;
};

}  // namespace lamplighter
