// Offers the work that a killed process has left.
#pragma once

#include <string>

#include "ui/widgets/widgets.h"

namespace lamplighter {

class RecoveryDialog {
 public:
  // The action that was chosen, or empty.
  std::string draw(PanelContext ui);

 private:
  bool later_ = false;  // asked for; not again until the next start
};

}  // namespace lamplighter
