// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "project/journal.h"

namespace argil::io {

/// Where a journal may begin instead of at its first step: with the state that so many undos lead
/// to from its end.
struct HistoryCut {
  std::size_t first = 0;  ///< step that it begins with
  int undos = 0;
};

struct HistoryBounds {
  std::size_t steps = 0;
  std::uint64_t bytes = 0;
  int undos = 0;  ///< what the sculpture can take back
};

/// The cut that keeps most within the bounds; nothing where there is none. No undo behind it
/// reaches before it, and which piece is active there is known: none becomes it behind the cut, or
/// the first step says which.
/// `journal`: read as a whole, without damage. `solid_bytes`: for each step those of the solid that
/// no later step names.
std::optional<HistoryCut> history_cut(const Journal& journal,
                                      const std::vector<std::uint64_t>& solid_bytes,
                                      const HistoryBounds& bounds);

/// The text of a journal of the steps from `first` on, without marks. `text`: of the whole one.
std::string steps_from(const Journal& journal, std::string_view text, std::size_t first,
                       const ScriptHeader& header);

/// The text of the journal from the cut on, with `base_hash` of the state there and, behind the
/// last step, the closing mark of `end_hash`. `text`: of the whole one.
std::string shortened(const Journal& journal, std::string_view text, std::size_t first,
                      const std::string& base_hash, const std::string& end_hash);

}  // namespace argil::io
