// Some rows of a picture.
#pragma once

namespace lamplighter {

struct Rows {
  int first = 0, last = 0;  // from the first to before the last
};

}  // namespace lamplighter
