// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <span>

#include <X11/Xlib.h>
#include <X11/extensions/XInput2.h>

namespace argil::viewer {

/// What devices tell the X server, read beside GLFW on a connection of its own: raw events take
/// nothing from what the window gets. X's headers define common words as macros: for sources only.
///
/// Threads  the window's.
class RawInput {
 public:
  /// Null where there is no X server with this version of XInput 2. `kinds` of raw events.
  static std::unique_ptr<RawInput> open(int minor_version, std::initializer_list<int> kinds);

  /// All that came since the last call, in order; `forget` where devices came or went, whose
  /// numbers mean something else from then on.
  void poll(const std::function<void(const XIRawEvent&)>& take,
            const std::function<void()>& forget);

  /// Calls `use` with a device and the properties of it, if it is still there.
  void ask(int device, const std::function<void(const XIDeviceInfo&)>& use) const;
  /// None where no device has it.
  Atom label(const char* name) const { return XInternAtom(display_.get(), name, True); }
  Display* display() const noexcept { return display_.get(); }

 private:
  struct CloseDisplay {
    void operator()(Display* shown) const { XCloseDisplay(shown); }
  };
  RawInput() = default;

  std::unique_ptr<Display, CloseDisplay> display_;
  int opcode_ = 0;
};

/// The classes of a device.
inline std::span<XIAnyClassInfo* const> classes_of(const XIDeviceInfo& device) {
  return {device.classes, static_cast<std::size_t>(device.num_classes)};
}

/// The bits of a raw event's values.
inline std::span<const unsigned char> mask_of(const XIRawEvent& event) {
  return {event.valuators.mask, static_cast<std::size_t>(event.valuators.mask_len)};
}

}  // namespace argil::viewer
