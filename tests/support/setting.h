// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace argil::test {

/// A variable of the environment, for as long as this lives: what the programs that a test starts
/// see. The test must have one thread.
class Setting {
 public:
  Setting(const char* name, const std::string& value) : name_(name) {
    // NOLINTBEGIN(concurrency-mt-unsafe): these tests have one thread
    if (const char* before = std::getenv(name)) before_ = before;
    ::setenv(name, value.c_str(), 1);
  }
  ~Setting() {
    if (before_) ::setenv(name_, before_->c_str(), 1);
    if (!before_) ::unsetenv(name_);
    // NOLINTEND(concurrency-mt-unsafe)
  }
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

}  // namespace argil::test
