// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/raw_input.h"

#include <array>
#include <cstddef>

namespace argil::viewer {

std::unique_ptr<RawInput> RawInput::open(int minor_version, std::initializer_list<int> kinds) {
  std::unique_ptr<RawInput> made(new RawInput);
  made->display_.reset(XOpenDisplay(nullptr));
  Display* display = made->display_.get();
  int first_event = 0;
  int first_error = 0;
  if (display == nullptr || XQueryExtension(display, "XInputExtension", &made->opcode_,
                                            &first_event, &first_error) == False) {
    return nullptr;
  }
  int major = 2;
  int minor = minor_version;
  if (XIQueryVersion(display, &major, &minor) != Success || major < 2 ||
      (major == 2 && minor < minor_version)) {
    return nullptr;
  }
  std::array<unsigned char, XIMaskLen(XI_LASTEVENT)> bits{};
  // As XISetMask, whose conversion compilers may warn of.
  const auto ask_for = [&bits](int kind) {
    unsigned char& byte = bits.at(static_cast<std::size_t>(kind / 8));
    byte = static_cast<unsigned char>(byte | 1U << static_cast<unsigned>(kind % 8));
  };
  for (const int kind : kinds) ask_for(kind);
  ask_for(XI_HierarchyChanged);
  XIEventMask mask{XIAllDevices, static_cast<int>(bits.size()), bits.data()};
  if (XISelectEvents(display, DefaultRootWindow(display), &mask, 1) != Success) return nullptr;
  XFlush(display);
  return made;
}

void RawInput::poll(const std::function<void(const XIRawEvent&)>& take,
                    const std::function<void()>& forget) {
  Display* display = display_.get();
  while (XPending(display) > 0) {
    XEvent event;
    XNextEvent(display, &event);
    if (event.xcookie.type != GenericEvent || event.xcookie.extension != opcode_ ||
        XGetEventData(display, &event.xcookie) == False) {
      continue;
    }
    if (event.xcookie.evtype == XI_HierarchyChanged) {
      forget();
    } else {
      take(*static_cast<const XIRawEvent*>(event.xcookie.data));
    }
    XFreeEventData(display, &event.xcookie);
  }
}

void RawInput::ask(int device, const std::function<void(const XIDeviceInfo&)>& use) const {
  int count = 0;
  // One that was unplugged meanwhile is not there, and asking for it alone would end the program.
  XIDeviceInfo* all = XIQueryDevice(display_.get(), XIAllDevices, &count);
  if (all == nullptr) return;
  for (const XIDeviceInfo& one : std::span(all, static_cast<std::size_t>(count))) {
    if (one.deviceid == device) use(one);
  }
  XIFreeDeviceInfo(all);
}

}  // namespace argil::viewer
