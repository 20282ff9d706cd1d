#include "host_tools/files/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// The permission bits of st_mode for owner, group and others; set-user-id and sticky bits are left
// out.
constexpr ::mode_t kPermissions = 0777;

// Opens a pipe, socket, terminal or null device for writing; returns -1 with errno set on failure.
int open_pipe(const std::filesystem::path& path) {
  // Standard output may be a file that a shell has opened: only its own descriptor knows where the
  // next byte goes.
  return is_standard_output(path) ? ::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1)
                                  : ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
}

// Gives the temporary file the permissions of the file that it replaces. Returns 0 or errno; a file
// that does not exist yet has none to keep.
int keep_permissions(int file, const std::filesystem::path& old) {
  struct stat status{};
  if (::stat(old.c_str(), &status) != 0) {
    return 0;
  }
  return ::fchmod(file, status.st_mode & kPermissions) == 0 ? 0 : errno;
}

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& output, OutputKind kind)
    : output_(output), place_(output_place(output, kind)) {
  if (place_.is_pipe) {
    partial_ = place_.file;
    file_ = hal::FileDescriptor(open_pipe(place_.file));
  } else {
    partial_ = partial_of(place_);
    file_ = hal::FileDescriptor(
        // O_EXCL and O_NOFOLLOW: nobody can plant a link under the temporary name that leads the
        // bytes into another file.
        ::open(partial_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666));
  }
  if (!file_.is_open()) {
    is_committed_ = true;  // there is nothing to remove
    fail(errno);
  }
}

OutputFile::~OutputFile() {
  if (!is_committed_ && !place_.is_pipe) {
    ::unlink(partial_.c_str());
  }
}

void OutputFile::fail(int error) {
  throw InputError(fmt::format("{}: cannot write: {}; check the folder and the space on the disk",
                               output_.string(), std::generic_category().message(error)));
}

void OutputFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file_.get(), bytes.data(), bytes.size());
    if (written < 0 && errno != EINTR) {
      fail(errno);
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written < 0 ? 0 : written));
  }
}

void OutputFile::commit() {
  if (!place_.is_pipe) {
    if (const int error = keep_permissions(file_.get(), place_.file); error != 0) {
      fail(error);
    }
    if (::fsync(file_.get()) != 0 || ::rename(partial_.c_str(), place_.file.c_str()) != 0) {
      fail(errno);
    }
  }
  is_committed_ = true;
}

}  // namespace tactus::host
