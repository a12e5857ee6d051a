#include "editor/recovery/append_file.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include "renderer/base/error.h"

namespace lamplighter {

Descriptor::~Descriptor() {
  if (number_ >= 0) ::close(number_);
}

AppendFile::AppendFile(const std::filesystem::path& path)
    : path_(path), file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600)) {
  if (!file_)
    throw InputError(path.string(), std::string("cannot be written (") + std::strerror(errno) + ")",
                     "free some space, or save your work now");
}

void AppendFile::append(std::string_view text) {
  size_t done = 0;
  int error = 0;
  while (done < text.size() && error == 0) {
    const ssize_t n = ::pwrite(file_.number(), text.data() + done, text.size() - done,
                               size_ + static_cast<int64_t>(done));
    if (n > 0)
      done += static_cast<size_t>(n);
    else if (n == 0)
      error = ENOSPC;
    else if (errno != EINTR)
      error = errno;
  }
  if (error == 0 && ::fdatasync(file_.number()) != 0) error = errno;
  if (error == 0) {
    size_ += static_cast<int64_t>(text.size());
    return;
  }
  // An incomplete line would end the journal for readers. If this also fails, the next line
  // overwrites it.
  if (::ftruncate(file_.number(), size_) != 0) errno = 0;
  throw InputError(path_.string(), std::string("cannot be written (") + std::strerror(error) + ")",
                   "free some space, or save your work now");
}

FileLock::FileLock(const std::filesystem::path& path)
    : file_(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600)) {
  if (file_ && ::flock(file_.number(), LOCK_EX | LOCK_NB) != 0) file_ = {};
}

void syncFolder(const std::filesystem::path& folder) {
  const Descriptor file(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (file && ::fsync(file.number()) != 0) errno = 0;  // some file systems do not support it
}

}  // namespace lamplighter
