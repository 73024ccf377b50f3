// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Model/COM/NMR_DLLInterfaces.h>

namespace argil::test {

/// A handle of lib3mf, released when this goes.
template <class Handle>
class Lib3mfHandle {
 public:
  Lib3mfHandle() = default;
  ~Lib3mfHandle() {
    if (handle_ != nullptr) NMR::lib3mf_release(handle_);
  }
  Lib3mfHandle(const Lib3mfHandle&) = delete;
  Lib3mfHandle& operator=(const Lib3mfHandle&) = delete;
  Handle** out() noexcept { return &handle_; }
  operator Handle*() const noexcept { return handle_; }  // NOLINT: stands for the handle

 private:
  Handle* handle_ = nullptr;
};

}  // namespace argil::test
