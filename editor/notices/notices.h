// What happened, in the order it happened: saved, undone, refused. The status line shows the last,
// toasts the newest, the log panel all that are kept.
#pragma once

#include <cstdint>
#include <deque>
#include <string>

namespace lamplighter {

// A hint says what to do next; it goes as soon as anything else is told.
enum class NoticeKind : uint8_t { info, hint, warning, error };

struct Notice {
  uint64_t id = 0;  // grows; another number once it happened again
  NoticeKind kind = NoticeKind::info;
  std::string text;  // one line
  int count = 1;     // how often it happened in a row
};

class Notices {
 public:
  // The same again is counted, not listed twice. Empty texts are none.
  void add(NoticeKind kind, const std::string& text);
  void clear() { all_.clear(); }
  const std::deque<Notice>& all() const { return all_; }  // the newest last

 private:
  static constexpr size_t kMost = 1000;
  std::deque<Notice> all_;
  uint64_t last_ = 0;
};

}  // namespace lamplighter
