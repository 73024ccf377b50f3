// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>

namespace argil::viewer {

/// Counts what a debug context reports as an error, for as long as it lives; in other contexts it
/// hears nothing. Threads: the one that has the context current.
class GlDebug {
 public:
  GlDebug();
  GlDebug(const GlDebug&) = delete;
  GlDebug& operator=(const GlDebug&) = delete;
  ~GlDebug();

  void add(const char* message);
  std::int64_t errors() const noexcept { return errors_; }
  const std::string& last_error() const noexcept { return last_error_; }

 private:
  bool listens_ = false;
  std::int64_t errors_ = 0;
  std::string last_error_;
};

}  // namespace argil::viewer
