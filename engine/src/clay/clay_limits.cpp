// SPDX-License-Identifier: GPL-3.0-or-later
// How much of the machine a clay may take.
#include <algorithm>
#include <limits>
#include <sstream>

#include "clay/clay_state.h"
#include "import/machine_memory.h"

namespace argil {
namespace {

constexpr double kFractionOfMachine = 0.75;

std::int64_t default_memory_bytes() {
  static const std::uint64_t machine = machine_bytes();
  constexpr auto kMost = static_cast<double>(std::numeric_limits<std::int64_t>::max() / 2);
  return static_cast<std::int64_t>(
      std::min(kMost, kFractionOfMachine * static_cast<double>(machine)));
}

std::int64_t whole_megabytes(std::int64_t bytes) { return (bytes + (1 << 20) - 1) >> 20; }

}  // namespace

Error out_of_memory(const char* what) {
  return {ErrorKind::memory,
          std::string("not enough memory to ") + what + "; use a larger voxel or a smaller tool"};
}

/// An OverLimit knows how much was asked for; the system's own bad_alloc does not.
Error out_of_memory(const std::bad_alloc& fault, const char* what) {
  const auto* over = dynamic_cast<const OverLimit*>(&fault);
  if (over == nullptr) return out_of_memory(what);
  std::ostringstream message;
  message << "to " << what << " takes " << whole_megabytes(over->needed)
          << " MB, more than the clay's memory limit leaves; use a smaller tool or a larger voxel, "
             "or raise the limit";
  return {ErrorKind::memory, message.str()};
}

std::int64_t Clay::State::free_bytes() const {
  const std::int64_t most = limits.memory_bytes > 0 ? limits.memory_bytes : default_memory_bytes();
  return most - leaf_bytes(*levels) - mask_bytes(*levels) - history.bytes() -
         (open ? open->bytes() : 0);
}

Result<void> Clay::set_limits(const ClayLimits& limits) {
  if (limits.undo_bytes < 0 || limits.memory_bytes < 0) {
    std::ostringstream message;
    message << "the limits are " << limits.undo_bytes << " bytes for undo and "
            << limits.memory_bytes << " in all; neither may be negative";
    return Error{ErrorKind::bad_input, message.str()};
  }
  const ChangingCall call(state_->user);
  state_->limits = limits;
  state_->history.trim(limits.undo_bytes);
  return {};
}

const ClayLimits& Clay::limits() const noexcept { return state_->limits; }

ClayUse Clay::use() const {
  return {leaf_bytes(levels()), state_->history.bytes(), state_->history.forgotten(),
          mask_bytes(levels()), state_->free_bytes()};
}

}  // namespace argil
