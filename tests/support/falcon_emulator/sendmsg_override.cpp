// SPDX-License-Identifier: GPL-3.0-or-later
// The program that is built with this file outlives a race of umockdev's: it looks who listens to
// the events of the emulated device, then sends to each, and aborts where libusb closed its socket
// in between ("uevent_sender sendmsg_one: sendmsg failed: Connection refused"). Who is gone hears
// nothing, as with the kernel's own events.
#include <cerrno>
#include <cstddef>

#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

// The C library declares it so; readability-identifier-naming has no say in its names.
extern "C" __attribute__((visibility("default"))) ssize_t sendmsg(int fd, const msghdr* message,
                                                                  int flags) {
  const auto sent = static_cast<ssize_t>(::syscall(SYS_sendmsg, fd, message, flags));
  const auto* to = static_cast<const sockaddr*>(message->msg_name);
  const bool is_local = to != nullptr && to->sa_family == AF_UNIX;
  if (sent >= 0 || !is_local || (errno != ECONNREFUSED && errno != ENOENT)) return sent;
  ssize_t length = 0;
  for (std::size_t n = 0; n < message->msg_iovlen; ++n) {
    length += static_cast<ssize_t>(message->msg_iov[n].iov_len);
  }
  return length;
}
