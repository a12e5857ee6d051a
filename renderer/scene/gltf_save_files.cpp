// Files that are there as a whole or not at all: each is written under another name beside its
// place and then renamed, which replaces at once.
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "renderer/error.h"
#include "renderer/scene/gltf_output.h"

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

// A file that goes away again unless it is renamed to its place.
class Pending {
 public:
  explicit Pending(const GltfOutput::File& file) : target_(file.path) {
    std::error_code error;
    const fs::file_status status = fs::status(target_, error);
    if (fs::exists(status)) {
      if (!fs::is_regular_file(status)) cannotWrite(target_, "it is no regular file");
      if ((status.permissions() & fs::perms::owner_write) == fs::perms::none) {
        cannotWrite(target_, "it is write-protected");
      }
    }
    std::string name =
        (folderOf(target_) / ("." + target_.filename().string() + ".XXXXXX")).string();
    const int descriptor = mkstemp(name.data());
    if (descriptor < 0) cannotWrite(target_, std::strerror(errno));
    temporary_ = name;
    try {
      writeAll(descriptor, file.bytes);
    } catch (...) {
      ::close(descriptor);
      ::unlink(temporary_.c_str());
      throw;
    }
    const bool isClosed = ::close(descriptor) == 0;
    if (!isClosed) {
      const std::string why = std::strerror(errno);
      ::unlink(temporary_.c_str());
      cannotWrite(target_, why);
    }
  }
  Pending(Pending&& other) noexcept
      : target_(std::move(other.target_)),
        temporary_(std::exchange(other.temporary_, {})),
        backup_(std::exchange(other.backup_, {})) {}
  Pending& operator=(Pending&&) = delete;
  ~Pending() {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
    if (!backup_.empty()) ::unlink(backup_.c_str());
  }

  // What is there now can be had back until the last file is in its place.
  void rename() {
    std::error_code error;
    if (fs::exists(target_, error)) {
      const fs::path backup = temporary_.string() + ".old";
      fs::create_hard_link(target_, backup, error);
      if (error) fs::copy_file(target_, backup, error);
      if (error) cannotWrite(target_, error.message());
      backup_ = backup;
    }
    fs::rename(temporary_, target_, error);
    if (error) cannotWrite(target_, error.message());
    temporary_.clear();
    isRenamed_ = true;
  }
  void undo() {
    if (!isRenamed_) return;
    std::error_code ignored;
    if (backup_.empty()) {
      fs::remove(target_, ignored);
    } else {
      fs::rename(backup_, target_, ignored);
      backup_.clear();
    }
  }

 private:
  void writeAll(int descriptor, const std::vector<uint8_t>& bytes) const {
    size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t written = ::write(descriptor, bytes.data() + done, bytes.size() - done);
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) cannotWrite(target_, std::strerror(errno));
      done += static_cast<size_t>(written);
    }
    // Temporary files are private; this one becomes an ordinary file. umask() can only be read by
    // setting it, so what is replaced, or else the usual, is taken.
    struct stat old {};
    const bool replaces = ::stat(target_.c_str(), &old) == 0;
    const mode_t mode = replaces ? old.st_mode & 0777 : 0644;
    if (::fchmod(descriptor, mode) != 0 || ::fsync(descriptor) != 0) {
      cannotWrite(target_, std::strerror(errno));
    }
  }

  fs::path target_, temporary_, backup_;
  bool isRenamed_ = false;
};

}  // namespace

void writeFilesAtomically(const std::vector<GltfOutput::File>& files) {
  std::vector<Pending> pending;
  pending.reserve(files.size());
  for (const GltfOutput::File& file : files) pending.emplace_back(file);
  try {
    for (Pending& file : pending) file.rename();
  } catch (const InputError&) {
    for (Pending& file : pending) file.undo();
    throw;
  }
}

}  // namespace lamplighter
