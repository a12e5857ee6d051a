// Offers to recover the work of killed processes.
#pragma once

#include "ui/widgets/widgets.h"

namespace lamplighter {

class RecoveryDialog {
 public:
  enum class Answer { none, discard, recover };
  // What the user chose for the newest of CrashRecovery::found() in this frame.
  Answer draw(PanelContext ui);

 private:
  bool later_ = false;  // the user chose "later": do not ask again until the next start
};

}  // namespace lamplighter
