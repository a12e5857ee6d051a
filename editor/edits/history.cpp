#include "editor/edits/history.h"

namespace lamplighter {

void History::push(std::string label, DocumentChange change) {
  for (size_t i = done_; i < steps_.size(); ++i) bytes_ -= steps_[i].bytes;
  steps_.resize(done_);
  const size_t bytes = sizeof(Step) + label.size() + change.bytes();
  steps_.push_back({std::move(label), std::move(change), bytes});
  bytes_ += bytes;
  done_ = steps_.size();
  forget();
}

void History::forget() {
  size_t count = 0;
  // Steps that are undone go last: nothing brings them back.
  for (; bytes_ > budget_ && count < done_ && count + 1 < steps_.size(); ++count)
    bytes_ -= steps_[count].bytes;
  steps_.erase(steps_.begin(), steps_.begin() + static_cast<std::ptrdiff_t>(count));
  done_ -= count;
  forgotten_ += count;
}

void History::setBudget(size_t bytes) {
  budget_ = bytes;
  forget();
}

void History::clear() {
  steps_.clear();
  done_ = forgotten_ = bytes_ = 0;
}

}  // namespace lamplighter
