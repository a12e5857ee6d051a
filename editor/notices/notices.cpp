#include "editor/notices/notices.h"

#include <algorithm>

namespace lamplighter {

void Notices::add(NoticeKind kind, const std::string& text) {
  if (text.empty()) return;
  ++last_;
  const bool isAgain = !all_.empty() && all_.back().text == text && all_.back().kind == kind;
  if (!all_.empty() && all_.back().kind == NoticeKind::hint && !isAgain) all_.pop_back();
  if (isAgain) {
    all_.back().id = last_;
    if (kind != NoticeKind::hint) ++all_.back().count;
    return;
  }
  Notice notice{last_, kind, text, 1};
  std::replace(notice.text.begin(), notice.text.end(), '\n', ' ');
  all_.push_back(std::move(notice));
  if (all_.size() > kMost) all_.pop_front();
}

}  // namespace lamplighter
