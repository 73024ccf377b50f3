// SPDX-License-Identifier: GPL-3.0-or-later
#include "input/pen.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <map>
#include <utility>

#include "input/raw_input.h"

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

struct Pen::Listener {
  /// What the server says of a device.
  struct Asked {
    std::optional<PressureAxis> axis;  ///< nothing for one without pressure
    bool is_eraser = false;
  };
  std::unique_ptr<RawInput> input;
  std::map<int, Asked> asked;  ///< by device; forgotten when devices come and go
  std::map<int, double> pressures;

  const Asked& about(int device) {
    const auto [found, is_new] = asked.try_emplace(device);
    if (is_new) found->second = ask(device);
    return found->second;
  }

  /// Asks the server which of a device's axes is its pressure, and for its name.
  Asked ask(int device) const {
    const Atom pressure = input->label("Abs Pressure");
    Asked answer;
    input->ask(device, [&](const XIDeviceInfo& info) {
      answer.is_eraser = info.name != nullptr && is_eraser_name(info.name);
      for (const XIAnyClassInfo* each : classes_of(info)) {
        if (each->type != XIValuatorClass) continue;
        const auto* valuator = reinterpret_cast<const XIValuatorClassInfo*>(each);
        if (pressure != None && valuator->label == pressure) {
          answer.axis = PressureAxis{valuator->number, valuator->min, valuator->max};
        }
      }
    });
    return answer;
  }

  /// Of the device that moved; the pressure is 1 for one that has none.
  PenState take(const XIRawEvent& event) {
    const auto& [axis, is_eraser] = about(event.sourceid);
    if (!axis) return {};
    double& pressure = pressures[event.sourceid];  // a motion tells only what changed
    pressure = pressure_in(*axis, mask_of(event), event.raw_values).value_or(pressure);
    return {pressure, is_eraser};
  }
};

std::unique_ptr<Pen> Pen::open() {
  constexpr int kMinor = 1;  // from which raw events come while a button is held too
  auto listener = std::make_unique<Listener>();
  listener->input = RawInput::open(kMinor, {XI_RawMotion});
  if (listener->input == nullptr) return nullptr;
  return std::unique_ptr<Pen>(new Pen(std::move(listener)));
}

Pen::Pen(std::unique_ptr<Listener> listener) : listener_(std::move(listener)) {}
Pen::~Pen() = default;

std::optional<PenState> Pen::poll() {
  assert(listener_ != nullptr);
  std::optional<PenState> newest;
  listener_->input->poll([&](const XIRawEvent& event) { newest = listener_->take(event); },
                         [&] { listener_->asked.clear(); });
  return newest;
}

}  // namespace argil::viewer
