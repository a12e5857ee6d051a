// Offers to recover the work of killed processes.
#pragma once

#include <string>

#include "ui/widgets/widgets.h"

namespace lamplighter {

class RecoveryDialog {
 public:
  // The action text that the user chose, or empty.
  std::string draw(PanelContext ui);

 private:
  bool later_ = false;  // the user chose "later": do not ask again until the next start
};

}  // namespace lamplighter
