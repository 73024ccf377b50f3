// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <sys/types.h>

namespace argil::test {

/// A device node that libusb can wait for: a FIFO that can be written to while something can be
/// reaped, and is full while nothing can.
class Doorbell {
 public:
  explicit Doorbell(const std::string& path);  ///< replaces what is there
  ~Doorbell();
  Doorbell(const Doorbell&) = delete;
  Doorbell& operator=(const Doorbell&) = delete;

  void ring(bool on) noexcept;
  bool is_node_of(int fd) const noexcept;

 private:
  int fd_;
  dev_t device_ = 0;
  ino_t inode_ = 0;
  bool rings_ = true;
};

}  // namespace argil::test
