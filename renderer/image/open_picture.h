// Pictures are opened one at a time: OpenImageIO 2.4 keeps the names of tags of colour profiles in
// a table that all threads share, and adds to it each tag that it does not know (its issue 3756,
// mended after 2.4.7), so that two threads that open such pictures may crash. Pixels are read
// outside of this.
#pragma once

#include <mutex>

namespace lamplighter {

// The lock, while a picture is opened.
inline std::unique_lock<std::mutex> openingAPicture() {
  static std::mutex mutex;  // the table is one for the whole program
  return std::unique_lock(mutex);
}

}  // namespace lamplighter
