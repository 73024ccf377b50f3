// SPDX-License-Identifier: GPL-3.0-or-later
// The functions beside their rows, and what every row must say.
#include <cassert>
#include <string_view>

#include "action/action.h"

namespace argil {
namespace {

constexpr AnyActionFunction kFunctions[] = {
#define ARGIL_ACTION(name, kind, ...) &actions::name,
#include "argil/engine/action_rows.h"
};

/// Nothing that the window shows is left out.
constexpr bool is_complete(const ActionInfo& info) {
  const bool has_words =
      !std::string_view(info.title).empty() && !std::string_view(info.help).empty();
  const bool has_key = (info.key >= 'A' && info.key <= 'Z') || info.key == kNoKey;
  return has_words && info.place > 0 && has_key;
}

/// The opposite of the opposite is the action itself; a negative strength needs none.
constexpr bool is_opposite_mutual(const ActionInfo& info) {
  if (!info.opposite) return true;
  return !info.is_signed && info_of(*info.opposite).opposite == info.action;
}

constexpr bool is_table_sound() {
  for (std::size_t n = 0; n < kActionCount; ++n) {
    const ActionInfo& info = kActionInfos[n];
    if (!is_complete(info) || !is_opposite_mutual(info)) return false;
    for (std::size_t m = 0; m < n; ++m) {
      const bool is_same_key = kActionInfos[m].key == info.key && info.key != kNoKey;
      if (is_same_key || kActionInfos[m].place == info.place) return false;
    }
  }
  return true;
}
static_assert(
    is_table_sound(),
    "each row of action_rows.h has a title, a help, a place and a key that no other has, or "
    "kNoKey, and opposites are mutual");

}  // namespace

AnyActionFunction function_of(Action action) noexcept {
  const auto n = static_cast<std::size_t>(action);
  assert(n < kActionCount);
  return kFunctions[n];
}

}  // namespace argil
