// SPDX-License-Identifier: GPL-3.0-or-later
#include "file/file_bytes.h"

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <memory>
#include <system_error>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "argil/core/no_throw.h"
#include "argil/io/safe_file.h"

#include "file/file_error.h"

namespace argil::io {
namespace {

const char* remedy_for(int code) {
  switch (code) {
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "free some space or choose another folder";
    case ENOENT:
    case ENOTDIR:
      return "check the spelling of the path";
    case EACCES:
    case EPERM:
    case EROFS:
      return "check the permissions of the file and its folder";
    case EISDIR:
      return "name a file, not a folder";
    default:
      return "check the disk";
  }
}

struct CloseHandle {
  void operator()(std::FILE* handle) const noexcept { std::fclose(handle); }
};

Result<UnwrittenBytes> read_all(const std::filesystem::path& file, const Progress& progress) {
  // Without waiting for whoever may write to a pipe of that name.
  const int opened = ::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (opened < 0) return disk_error("read", file, errno);
  const std::unique_ptr<std::FILE, CloseHandle> handle(::fdopen(opened, "rb"));
  if (!handle) {
    const int failed_with = errno;
    ::close(opened);
    return disk_error("read", file, failed_with);
  }
  struct stat info {};
  if (::fstat(opened, &info) != 0) return disk_error("read", file, errno);
  if (S_ISDIR(info.st_mode)) return disk_error("read", file, EISDIR);
  if (!S_ISREG(info.st_mode)) {
    return file_error(ErrorKind::bad_input, file, " is a pipe or a device; name a file");
  }
  // A file that grows meanwhile is read as it was; one that shrinks gives fewer bytes.
  UnwrittenBytes bytes(static_cast<std::size_t>(info.st_size));
  constexpr std::size_t kPiece = std::size_t{1} << 24;
  std::size_t got = 0;
  while (got < bytes.size()) {
    const std::size_t wanted = std::min(kPiece, bytes.size() - got);
    const std::size_t more = std::fread(bytes.data() + got, 1, wanted, handle.get());
    if (std::ferror(handle.get()) != 0) return disk_error("read", file, errno);
    got += more;
    if (more < wanted) break;
    if (got == bytes.size()) break;
    if (interrupted() || (progress && !progress("read", 0.0))) {
      return file_error(ErrorKind::interrupted, file, " was not read: interrupted");
    }
  }
  bytes.resize(got);
  return bytes;
}

}  // namespace

Error disk_error(std::string_view doing, const std::filesystem::path& file, int code) {
  return {ErrorKind::disk, "cannot " + std::string(doing) + " '" + file.string() + "': " +
                               std::generic_category().message(code) + "; " + remedy_for(code)};
}

Result<UnwrittenBytes> read_file_bytes(const std::filesystem::path& file,
                                       const Progress& progress) {
  return no_throw(file.string(), [&] { return read_all(file, progress); });
}

OutputFile::OutputFile(const std::filesystem::path& file) : file_(file) {
  // "e" is O_CLOEXEC (glibc). stdio may fail without setting errno: EIO then.
  handle_ = std::fopen(file.c_str(), "wbe");
  if (handle_ == nullptr) failed_with_ = errno == 0 ? EIO : errno;
}

OutputFile::~OutputFile() {
  if (handle_ != nullptr) std::fclose(handle_);
}

void OutputFile::note(bool success) noexcept {
  if (!success && failed_with_ == 0) failed_with_ = errno == 0 ? EIO : errno;
}

void OutputFile::write(const void* data, std::size_t size) noexcept {
  assert(data != nullptr || size == 0);
  if (good()) note(std::fwrite(data, 1, size, handle_) == size);
}

std::uint64_t OutputFile::position() noexcept {
  if (!good()) return 0;
  const off_t at = ::ftello(handle_);
  note(at >= 0);
  return at < 0 ? 0 : static_cast<std::uint64_t>(at);
}

void OutputFile::seek(std::uint64_t position) noexcept {
  if (good()) note(::fseeko(handle_, static_cast<off_t>(position), SEEK_SET) == 0);
}

Result<void> OutputFile::close() {
  if (handle_ != nullptr) {
    // A full disk may show only here, where the buffer is written out.
    const bool closed = std::fclose(handle_) == 0;
    handle_ = nullptr;
    note(closed);
  }
  if (!good()) return disk_error("write", file_, failed_with_);
  return {};
}

}  // namespace argil::io
