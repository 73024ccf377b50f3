// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/tool_option.h"

#include <algorithm>
#include <string_view>

#include "common/options.h"

namespace argil::cli {
namespace {

using haptics::ForceTool;

/// "NAME:" followed by `count` numbers; false when the text starts otherwise.
bool read_shape(const std::string& text, std::string_view name, const char* form, bool triple,
                Vec3& radii) {
  if (!text.starts_with(name)) return false;
  const std::string numbers = text.substr(name.size());
  if (triple) {
    radii = parse_triple(form, numbers);
  } else {
    const double r = parse_number(form, numbers, kPositive);
    radii = {r, r, r};
  }
  return true;
}

/// capsule:R,L is a ball of radius R swept along L mm of its z axis.
bool read_capsule(const std::string& text, ForceTool& tool) {
  constexpr std::string_view kCapsule = "capsule:";
  const std::size_t comma = text.find(',');
  if (!text.starts_with(kCapsule) || comma == std::string::npos) return false;
  const char* form = "--tool capsule:R,L";
  const double radius =
      parse_number(form, text.substr(kCapsule.size(), comma - kCapsule.size()), kPositive);
  const double length = parse_number(form, text.substr(comma + 1), kPositive);
  tool.shape = haptics::ToolShape::capsule;
  // Half extents: along z half of the straight part besides.
  tool.radii_mm = {radius, radius, radius + 0.5 * length};
  return true;
}

}  // namespace

void read_tool(const std::string& text, ForceTool& tool) {
  tool.shape = haptics::ToolShape::ellipsoid;
  bool known = read_shape(text, "ball:", "--tool ball:R", false, tool.radii_mm) ||
               read_shape(text, "ellipsoid:", "--tool ellipsoid:A,B,C", true, tool.radii_mm);
  if (!known && read_shape(text, "box:", "--tool box:A,B,C", true, tool.radii_mm)) {
    tool.shape = haptics::ToolShape::box;
    known = true;
  }
  known = known || read_capsule(text, tool);
  if (known && std::min({tool.radii_mm.x, tool.radii_mm.y, tool.radii_mm.z}) > 0.0) return;
  throw CLI::ValidationError("--tool is '" + text +
                             "'; must be ball:R, ellipsoid:A,B,C, box:A,B,C (half sides) or "
                             "capsule:R,L with lengths in mm greater than 0");
}

Result<Tool> working_tool(const ForceTool& felt, std::size_t action) {
  if (felt.shape != haptics::ToolShape::ellipsoid) {
    return Error{
        ErrorKind::bad_input,
        "--tool must be ball:R or ellipsoid:A,B,C here: the clay is worked with no others"};
  }
  const Vec3& radii = felt.radii_mm;
  Tool tool;
  tool.action = kWorkActions.at(action);
  tool.shape = radii.x == radii.y && radii.y == radii.z ? Shape::ball : Shape::ellipsoid;
  tool.radii_mm = radii;
  if (auto good = validate_tool(tool); !good) return good.error();
  return tool;
}

}  // namespace argil::cli
