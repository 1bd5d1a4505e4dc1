// SPDX-License-Identifier: Apache-2.0
#include "sil/scenario/runs/run_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>

namespace striker::sil {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, int handle, const std::string& what) {
  if (handle >= 0) {
    close(handle);
  }
  throw std::runtime_error(fmt::format("{}: {}", file.string(), what));
}

// Who was here before removed the file between our opening and our locking it: the lock is of nothing.
bool is_removed(int handle) {
  struct stat status = {};
  return fstat(handle, &status) == 0 && status.st_nlink == 0;
}

}  // namespace

RunLock::RunLock(const std::filesystem::path& file) : lock_(file.string() + ".lock") {
  do {
    if (handle_ >= 0) {
      close(handle_);
    }
    handle_ = open(lock_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    struct flock lock = {};
    lock.l_type = F_WRLCK;
    if (handle_ < 0 || fcntl(handle_, F_SETLK, &lock) != 0) {
      const int error = errno;
      if (handle_ >= 0 && (error == EACCES || error == EAGAIN)) {
        fcntl(handle_, F_GETLK, &lock);
        refuse(file, handle_,
               fmt::format("the process {} is at it: wait until it has ended, or give another --out",
                           lock.l_pid));
      }
      refuse(lock_, handle_,
             fmt::format("cannot be locked ({}): give an --out where files can",
                         std::generic_category().message(error)));
    }
  } while (is_removed(handle_));
}

RunLock::~RunLock() {
  unlink(lock_.c_str());
  close(handle_);
}

}  // namespace striker::sil
