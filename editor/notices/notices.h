// Messages about events, in order: saved, undone, rejected. The status line shows the last one,
// toasts show the newest ones, and the log panel shows all that are kept.
#pragma once

#include <cstdint>
#include <deque>
#include <string>

namespace lamplighter {

// A hint says what to do next. The next notice removes it.
enum class NoticeKind : uint8_t { info, hint, warning, error };

struct Notice {
  uint64_t id = 0;  // increases; a repeated notice gets a new id
  NoticeKind kind = NoticeKind::info;
  std::string text;  // one line
  int count = 1;     // number of repetitions in a row
};

class Notices {
 public:
  // A repeated notice is counted and not listed twice. Empty texts are ignored.
  void add(NoticeKind kind, const std::string& text);
  void clear() { all_.clear(); }
  const std::deque<Notice>& all() const { return all_; }  // newest last

 private:
  static constexpr size_t kMost = 1000;
  std::deque<Notice> all_;
  uint64_t last_ = 0;
};

}  // namespace lamplighter
