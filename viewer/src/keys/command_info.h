// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>

#include "keys/key_set.h"

namespace argil::viewer {

/// Everything that a key, a menu entry or a button does. Widgets only name commands; perform()
/// (command.h) does them.
enum class Command {
#define ARGIL_COMMAND(name, ...) name,
#include "keys/command_rows.h"
};

/// A row of the table (command_rows.h).
struct CommandInfo {
  Command command = Command::undo;
  const char* name = "";  ///< in files of keys
  const char* menu = "";  ///< the menu that lists it
  const char* title = "";
  std::array<const char*, kKeySetCount> chords{};  ///< of each KeySet: "Ctrl+Z"; "" none
};
/// All of them, each at the place of its number.
std::span<const CommandInfo> command_infos() noexcept;
const CommandInfo& info_of(Command command) noexcept;

}  // namespace argil::viewer
