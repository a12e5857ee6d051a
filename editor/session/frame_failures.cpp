#include "editor/session/frame_failures.h"

#include "editor/notices/failure_text.h"
#include "renderer/base/error.h"

namespace lamplighter {

FrameFailures::Next FrameFailures::failed(const std::exception& e, const Input& input,
                                          bool isOnGl) {
  const bool isOfInput = dynamic_cast<const InputError*>(&e) != nullptr;
  why_ = (isOfInput ? "" : "The picture cannot be computed: ") + failureText(e);
  input_ = input;
  count_ = isOfInput ? 0 : count_ + 1;
  waits_ = isOfInput || (count_ > 1 && !isOnGl);
  if (waits_) return Next::wait;
  if (count_ == 1) return Next::tryAgain;
  count_ = 0;  // the other backend gets as many attempts
  return Next::leaveGl;
}

}  // namespace lamplighter
