// Serialises the opening of pictures. OpenImageIO 2.4 adds each unknown tag of a colour profile to
// a table that all threads share, without a lock (issue 3756, fixed after 2.4.7). Two threads that
// open such pictures at the same time may crash. Reading pixels needs no lock.
#pragma once

#include <mutex>

namespace lamplighter {

// Returns the lock; hold it while a picture is opened.
inline std::unique_lock<std::mutex> openingAPicture() {
  static std::mutex mutex;  // the table is global, so is the lock
  return std::unique_lock(mutex);
}

}  // namespace lamplighter
