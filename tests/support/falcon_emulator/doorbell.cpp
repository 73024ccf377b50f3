// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/falcon_emulator/doorbell.h"

#include <stdexcept>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace argil::test {
namespace {

constexpr int kPipeBytes = 4096;  // one slot: a single byte fills it

}  // namespace

Doorbell::Doorbell(const std::string& path) {
  ::unlink(path.c_str());
  fd_ = ::mkfifo(path.c_str(), 0600) == 0 ? ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC)
                                          : -1;
  struct stat node {};
  if (fd_ < 0 || ::fstat(fd_, &node) != 0 || ::fcntl(fd_, F_SETPIPE_SZ, kPipeBytes) < 0) {
    throw std::runtime_error("no device node at " + path);
  }
  device_ = node.st_dev;
  inode_ = node.st_ino;
  ring(false);
}

Doorbell::~Doorbell() { ::close(fd_); }

void Doorbell::ring(bool on) noexcept {
  if (on == rings_) return;
  char byte = 0;
  rings_ = (on ? ::read(fd_, &byte, 1) : ::write(fd_, &byte, 1)) == 1 ? on : rings_;
}

bool Doorbell::is_node_of(int fd) const noexcept {
  struct stat node {};
  return ::fstat(fd, &node) == 0 && node.st_dev == device_ && node.st_ino == inode_;
}

}  // namespace argil::test
