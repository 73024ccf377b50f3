// SPDX-License-Identifier: GPL-3.0-or-later
#include "document/tool_info.h"

#include <algorithm>
#include <array>

namespace argil::viewer {
namespace {

/// Add as it prints a mesh.
constexpr ToolInfo stamp() {
  ToolInfo info{info_of(Action::add), true};
  info.name = "stamp";
  info.place = 45;
  info.key = 'K';
  info.title = "Stamp";
  info.help = "puts a shape or a mesh on, once for each press; Ctrl imprints it";
  info.picture = {.before = {}, .after = {.print = 0.42F}, .hand = HandMark::handle};
  return info;
}

constexpr auto kTools = [] {
  std::array<ToolInfo, kActionCount + 1> tools{};
  for (std::size_t n = 0; n < kActionCount; ++n) tools[n] = {kActionInfos[n], false};
  tools.back() = stamp();
  std::sort(tools.begin(), tools.end(),
            [](const ToolInfo& a, const ToolInfo& b) { return a.place < b.place; });
  return tools;
}();

}  // namespace

std::span<const ToolInfo> tool_infos() noexcept { return kTools; }

}  // namespace argil::viewer
