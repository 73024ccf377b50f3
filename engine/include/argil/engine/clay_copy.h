// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <limits>
#include <memory>

#include "argil/engine/clay.h"

namespace argil {

/// A copy of a clay made in pieces between strokes, so that no stroke waits for all of it: what
/// changes after its piece was copied is copied again. The mask, small, is copied whole at the end.
/// The copy has no history.
///
/// Accuracy     complete, it has the bits that the clay has then
///              (LevelCopy.HasTheBitsOfTheClayThatWentOn).
/// Threads      the clay's.
/// Cost         a piece: `most_leaves` leaves of 2 KB and those that changed since.
class ClayCopy {
 public:
  static constexpr std::size_t kAllLeaves = std::numeric_limits<std::size_t>::max();

  explicit ClayCopy(const Clay& clay);
  ~ClayCopy();
  ClayCopy(ClayCopy&&) noexcept;
  ClayCopy& operator=(ClayCopy&&) noexcept;

  /// Copies about so many leaves more, whole branches of 16^3; `clay` is that of the constructor.
  /// True when the copy is complete and has the clay's bits. One call on a small clay.
  bool advance(const Clay& clay, std::size_t most_leaves);

  /// The copy, once complete.
  Clay take() &&;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The clay as it stands, with nothing to undo. Threads  the clay's.
Clay copy_of(const Clay& clay);

}  // namespace argil
