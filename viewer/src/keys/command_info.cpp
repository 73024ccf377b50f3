// SPDX-License-Identifier: GPL-3.0-or-later
#include "keys/command_info.h"

#include <cassert>
#include <cstddef>

namespace argil::viewer {
namespace {

constexpr CommandInfo kCommands[] = {
#define ARGIL_COMMAND(name, menu, title, key, blender, zbrush) \
  {Command::name, #name, menu, title, {key, blender, zbrush}},
#include "keys/command_rows.h"
};

}  // namespace

std::span<const CommandInfo> command_infos() noexcept { return kCommands; }

const CommandInfo& info_of(Command command) noexcept {
  const CommandInfo& info = kCommands[static_cast<std::size_t>(command)];
  assert(info.command == command);
  return info;
}

}  // namespace argil::viewer
