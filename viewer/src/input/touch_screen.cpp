// SPDX-License-Identifier: GPL-3.0-or-later
// Raw events have the places of fingers as the server made them, calibrated, in units of the
// device.
#include "input/touch_screen.h"

#include <cassert>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "input/pen.h"
#include "input/raw_input.h"

namespace argil::viewer {

std::optional<double> pixel_in(const TouchAxis& axis, std::span<const unsigned char> mask,
                               const double* values) noexcept {
  const auto share = pressure_in({axis.number, axis.least, axis.most}, mask, values);
  if (!share) return std::nullopt;
  return *share * axis.pixels;
}

struct TouchScreen::Listener {
  /// The axes of a device that lie on the screen; nothing for a touch pad.
  struct Axes {
    TouchAxis x;
    TouchAxis y;
  };
  std::unique_ptr<RawInput> input;
  std::map<int, std::optional<Axes>> asked;   ///< by device; forgotten when devices come and go
  std::map<unsigned, Camera::Pixel> fingers;  ///< that are down

  const std::optional<Axes>& about(int device) {
    const auto [found, is_new] = asked.try_emplace(device);
    if (is_new) found->second = ask(device);
    return found->second;
  }

  std::optional<Axes> ask(int device) const {
    std::optional<Axes> answer;
    input->ask(device, [&](const XIDeviceInfo& info) {
      bool is_direct = false;
      std::optional<TouchAxis> x;
      std::optional<TouchAxis> y;
      for (const XIAnyClassInfo* each : classes_of(info)) {
        if (each->type == XITouchClass) {
          is_direct = reinterpret_cast<const XITouchClassInfo*>(each)->mode == XIDirectTouch;
        }
        if (each->type != XIValuatorClass) continue;
        const auto* valuator = reinterpret_cast<const XIValuatorClassInfo*>(each);
        const auto axis = [&](int pixels) {
          return TouchAxis{valuator->number, valuator->min, valuator->max,
                           static_cast<double>(pixels)};
        };
        const int screen = DefaultScreen(input->display());
        if (is(valuator->label, "Abs MT Position X")) {
          x = axis(DisplayWidth(input->display(), screen));
        }
        if (is(valuator->label, "Abs MT Position Y")) {
          y = axis(DisplayHeight(input->display(), screen));
        }
      }
      if (is_direct && x && y) answer = Axes{*x, *y};
    });
    return answer;
  }
  bool is(Atom label, const char* name) const {
    return label != None && label == input->label(name);
  }

  void take(const XIRawEvent& event, std::vector<FingerEvent>& out) {
    const std::optional<Axes>& axes = about(event.sourceid);
    if (!axes) return;
    const auto finger = static_cast<unsigned>(event.detail);
    if (event.evtype == XI_RawTouchEnd) {
      const auto found = fingers.find(finger);
      if (found == fingers.end()) return;
      out.push_back({FingerEvent::What::up, finger, found->second});
      fingers.erase(found);
      return;
    }
    const auto [found, is_new] = fingers.try_emplace(finger);
    Camera::Pixel& at = found->second;  // an event tells only what changed
    at.x = pixel_in(axes->x, mask_of(event), event.valuators.values).value_or(at.x);
    at.y = pixel_in(axes->y, mask_of(event), event.valuators.values).value_or(at.y);
    out.push_back({is_new ? FingerEvent::What::down : FingerEvent::What::move, finger, at});
  }
};

std::unique_ptr<TouchScreen> TouchScreen::open() {
  constexpr int kMinor = 2;  // which has touches
  auto listener = std::make_unique<Listener>();
  listener->input = RawInput::open(kMinor, {XI_RawTouchBegin, XI_RawTouchUpdate, XI_RawTouchEnd});
  if (listener->input == nullptr) return nullptr;
  return std::unique_ptr<TouchScreen>(new TouchScreen(std::move(listener)));
}

TouchScreen::TouchScreen(std::unique_ptr<Listener> listener) : listener_(std::move(listener)) {}
TouchScreen::~TouchScreen() = default;

std::vector<FingerEvent> TouchScreen::poll() {
  assert(listener_ != nullptr);
  std::vector<FingerEvent> all;
  listener_->input->poll([&](const XIRawEvent& event) { listener_->take(event, all); },
                         [&] {
                           // A screen that was unplugged lifts no finger.
                           for (const auto& [finger, at] : std::exchange(listener_->fingers, {})) {
                             all.push_back({FingerEvent::What::up, finger, at});
                           }
                           listener_->asked.clear();
                         });
  return all;
}

bool TouchScreen::is_touched() const noexcept { return !listener_->fingers.empty(); }

}  // namespace argil::viewer
