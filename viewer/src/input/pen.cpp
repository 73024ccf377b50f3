// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/pen.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <map>
#include <utility>

#include <X11/Xlib.h>
#include <X11/extensions/XInput2.h>

namespace argil::viewer {

std::optional<double> pressure_in(const PressureAxis& axis, std::span<const unsigned char> mask,
                                  const double* values) noexcept {
  const auto is_set = [&](int number) {
    const auto byte = static_cast<std::size_t>(number >> 3);
    return byte < mask.size() && (mask[byte] >> (number & 7) & 1) != 0;
  };
  assert(axis.number >= 0);
  if (!is_set(axis.number) || !(axis.most > axis.least)) return std::nullopt;
  // Values are packed: one for each bit that is set before this axis.
  for (int number = 0; number < axis.number; ++number) values += is_set(number) ? 1 : 0;
  return std::clamp((*values - axis.least) / (axis.most - axis.least), 0.0, 1.0);
}

bool is_eraser_name(std::string_view device) noexcept {
  constexpr std::string_view kEraser = "eraser";
  return std::search(device.begin(), device.end(), kEraser.begin(), kEraser.end(),
                     [](unsigned char a, unsigned char b) { return std::tolower(a) == b; }) !=
         device.end();
}

/// The connection to the X server, of its own: GLFW reads all events of its connection.
struct Pen::Listener {
  struct CloseDisplay {
    void operator()(Display* shown) const { XCloseDisplay(shown); }
  };

  std::unique_ptr<Display, CloseDisplay> display;
  int opcode = 0;
  /// What the server says of a device.
  struct Asked {
    std::optional<PressureAxis> axis;  ///< nothing for one without pressure
    bool is_eraser = false;
  };
  std::map<int, Asked> asked;  ///< by device; forgotten when devices come and go
  std::map<int, double> pressures;

  /// Asks the server for raw motions of all devices. False without XInput 2.1.
  bool listen() {
    int first_event = 0;
    int first_error = 0;
    if (XQueryExtension(display.get(), "XInputExtension", &opcode, &first_event, &first_error) ==
        False) {
      return false;
    }
    int major = 2;
    int minor = 1;  // from which raw events come while a button is held too
    if (XIQueryVersion(display.get(), &major, &minor) != Success) return false;
    std::array<unsigned char, XIMaskLen(XI_LASTEVENT)> bits{};
    XISetMask(bits.data(), XI_RawMotion);
    XISetMask(bits.data(), XI_HierarchyChanged);
    XIEventMask mask{XIAllDevices, static_cast<int>(bits.size()), bits.data()};
    if (XISelectEvents(display.get(), DefaultRootWindow(display.get()), &mask, 1) != Success) {
      return false;
    }
    XFlush(display.get());
    return true;
  }

  const Asked& about(int device) {
    const auto [found, is_new] = asked.try_emplace(device);
    if (is_new) found->second = ask(device);
    return found->second;
  }

  /// Asks the server which of a device's axes is its pressure, and for its name.
  Asked ask(int device) {
    const Atom pressure = XInternAtom(display.get(), "Abs Pressure", True);
    int count = 0;
    // One that was unplugged meanwhile is not there, and asking for it alone would end the program.
    XIDeviceInfo* all = XIQueryDevice(display.get(), XIAllDevices, &count);
    Asked answer;
    if (all == nullptr) return answer;
    const std::span<const XIDeviceInfo> devices(all, static_cast<std::size_t>(count));
    const auto info = std::find_if(devices.begin(), devices.end(),
                                   [&](const XIDeviceInfo& one) { return one.deviceid == device; });
    if (info != devices.end() && info->name != nullptr) {
      answer.is_eraser = is_eraser_name(info->name);
    }
    for (int n = 0; info != devices.end() && n < info->num_classes; ++n) {
      if (info->classes[n]->type != XIValuatorClass) continue;
      const auto* valuator = reinterpret_cast<const XIValuatorClassInfo*>(info->classes[n]);
      if (pressure != None && valuator->label == pressure) {
        answer.axis = PressureAxis{valuator->number, valuator->min, valuator->max};
      }
    }
    XIFreeDeviceInfo(all);
    return answer;
  }

  /// Of the device that moved; the pressure is 1 for one that has none.
  PenState take(const XIRawEvent& event) {
    const auto& [axis, is_eraser] = about(event.sourceid);
    if (!axis) return {};
    const std::span<const unsigned char> mask(event.valuators.mask,
                                              static_cast<std::size_t>(event.valuators.mask_len));
    double& pressure = pressures[event.sourceid];  // a motion tells only what changed
    pressure = pressure_in(*axis, mask, event.raw_values).value_or(pressure);
    return {pressure, is_eraser};
  }
};

std::unique_ptr<Pen> Pen::open() {
  auto listener = std::make_unique<Listener>();
  listener->display.reset(XOpenDisplay(nullptr));
  if (listener->display == nullptr || !listener->listen()) return nullptr;
  return std::unique_ptr<Pen>(new Pen(std::move(listener)));
}

Pen::Pen(std::unique_ptr<Listener> listener) : listener_(std::move(listener)) {}
Pen::~Pen() = default;

std::optional<PenState> Pen::poll() {
  assert(listener_ != nullptr);
  std::optional<PenState> newest;
  Display* display = listener_->display.get();
  while (XPending(display) > 0) {
    XEvent event;
    XNextEvent(display, &event);
    if (event.xcookie.type != GenericEvent || event.xcookie.extension != listener_->opcode ||
        XGetEventData(display, &event.xcookie) == False) {
      continue;
    }
    // A number may be given to another device: which axis is the pressure is asked again.
    if (event.xcookie.evtype == XI_HierarchyChanged) listener_->asked.clear();
    if (event.xcookie.evtype == XI_RawMotion) {
      newest = listener_->take(*static_cast<const XIRawEvent*>(event.xcookie.data));
    }
    XFreeEventData(display, &event.xcookie);
  }
  return newest;
}

}  // namespace argil::viewer
