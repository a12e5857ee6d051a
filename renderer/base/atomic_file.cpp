#include "renderer/base/atomic_file.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "renderer/base/error.h"

namespace lamplighter {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void cannotWrite(const fs::path& path, const std::string& why) {
  throw InputError(path.string(), "cannot be written (" + why + ")",
                   "nothing was changed; free some space, or save to another place");
}

fs::path folderOf(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : ".";
}

}  // namespace

PendingFile::PendingFile(const fs::path& target, std::span<const uint8_t> bytes) : target_(target) {
  std::error_code error;
  const fs::file_status status = fs::status(target_, error);
  if (fs::exists(status)) {
    if (!fs::is_regular_file(status)) cannotWrite(target_, "it is not a regular file");
    if ((status.permissions() & fs::perms::owner_write) == fs::perms::none)
      cannotWrite(target_, "it is write-protected");
  }
  std::string name = (folderOf(target_) / ("." + target_.filename().string() + ".XXXXXX")).string();
  const int descriptor = mkstemp(name.data());
  if (descriptor < 0) cannotWrite(target_, std::strerror(errno));
  temporary_ = name;
  try {
    writeAll(descriptor, bytes);
  } catch (...) {
    ::close(descriptor);
    ::unlink(temporary_.c_str());
    throw;
  }
  if (::close(descriptor) == 0) return;
  const std::string why = std::strerror(errno);
  ::unlink(temporary_.c_str());
  cannotWrite(target_, why);
}

PendingFile::PendingFile(PendingFile&& other) noexcept
    : target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      backup_(std::exchange(other.backup_, {})),
      isInPlace_(std::exchange(other.isInPlace_, false)) {}

PendingFile::~PendingFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  if (!backup_.empty()) ::unlink(backup_.c_str());
}

void PendingFile::putInPlace() {
  std::error_code error;
  // Keeps a backup of the old file until the last of several files is in place.
  if (fs::exists(target_, error)) {
    const fs::path backup = temporary_.string() + ".old";
    fs::create_hard_link(target_, backup, error);
    if (error) fs::copy_file(target_, backup, error);
    if (error) {
      const std::string why = error.message();
      fs::remove(backup, error);
      cannotWrite(target_, why);
    }
    backup_ = backup;
  }
  fs::rename(temporary_, target_, error);
  if (error) cannotWrite(target_, error.message());
  temporary_.clear();
  isInPlace_ = true;
  // Flushes the folder, so that the new name survives a power failure; some file systems do not
  // support this, so errors are ignored.
  const int folder = ::open(folderOf(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  if (::fsync(folder) != 0) errno = 0;
  ::close(folder);
}

void PendingFile::undo() {
  if (!isInPlace_) return;
  std::error_code ignored;
  if (backup_.empty()) {
    fs::remove(target_, ignored);
  } else {
    fs::rename(backup_, target_, ignored);
    backup_.clear();
  }
}

void PendingFile::writeAll(int descriptor, std::span<const uint8_t> bytes) const {
  size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t written = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) cannotWrite(target_, std::strerror(written < 0 ? errno : ENOSPC));
    done += static_cast<size_t>(written);
  }
  // Temporary files are private; this one needs ordinary permissions. umask() can only be read by
  // setting it, so the permissions of the replaced file are used, or else the usual ones.
  struct stat old {};
  const bool replaces = ::stat(target_.c_str(), &old) == 0;
  const mode_t mode = replaces ? old.st_mode & 0777 : 0644;
  if (::fchmod(descriptor, mode) != 0 || ::fsync(descriptor) != 0)
    cannotWrite(target_, std::strerror(errno));
}

void writeWhole(const fs::path& target, std::span<const uint8_t> bytes) {
  PendingFile file(target, bytes);
  file.putInPlace();
}

}  // namespace lamplighter
