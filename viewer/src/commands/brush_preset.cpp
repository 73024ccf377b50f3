// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/brush_preset.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

#include "argil/core/free_name.h"
#include "argil/io/safe_file.h"
#include "argil/io/settings_file.h"

#include "document/tool_info.h"
#include "settings/unread_file.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostPresetName = 60;  // bytes
constexpr const char* kPresetFormat = "argil_brush";

/// What a file may say, in its words: the ranges are those of the brush's panel.
struct PresetNumber {
  const char* name;
  double Brush::*at;
  double least;
  double most;
};
constexpr PresetNumber kPresetNumbers[] = {
    {"size_mm", &Brush::radius_mm, kLeastRadiusMm, kMostRadiusMm},
    {"size_pixels", &Brush::radius_pixels, 2.0, 2000.0},
    {"strength", &Brush::strength, kLeastStrength, 1.0},
    {"height", &Brush::height, kLeastHeight, kMostHeight},
    {"turn_deg", &Brush::turn_deg, -180.0, 180.0},
    {"pressure_to_strength", &Brush::pressure_to_strength, 0.0, 1.0},
    {"pressure_to_size", &Brush::pressure_to_size, 0.0, 1.0},
    {"sharpness", &Brush::sharpness, 0.0, 1.0},
    {"width", &Brush::width, 0.3, 1.0},
    {"plane_offset", &Brush::plane_offset, -1.0, 1.0},
    {"tip_roundness", &Brush::tip_roundness, 0.05, 1.0},
    {"volume_preservation", &Brush::volume_preservation, 0.0, 1.0},
    {"crease_pinch_factor", &Brush::crease_pinch_factor, 0.0, 1.0},
    {"wavelength", &Brush::wavelength, 0.1, 2.0},
    {"amplitude", &Brush::amplitude, 0.01, 1.0},
    {"mid_level", &Brush::mid_level, 0.0, 1.0},
    {"angle_deg", &Brush::angle_deg, -180.0, 180.0},
    {"tile", &Brush::tile, 0.1, 4.0},
    {"spacing", &Brush::spacing, 0.05, 2.0},
    {"steady_mm", &Brush::steady_mm, 0.0, 20.0},
    {"hold_s", &Brush::hold_s, 0.0, 1.0}};

constexpr std::pair<const char*, bool Brush::*> kPresetFlags[] = {
    {"is_screen_size", &Brush::is_screen_size},
    {"is_inverted", &Brush::is_inverted},
    {"use_rake", &Brush::use_rake}};

// Each at the place of its number. A mesh is no shape of a preset: it is of a file elsewhere.
constexpr std::array<std::string_view, 4> kPresetShapes{"ball", "ellipsoid", "box", "capsule"};
constexpr std::array<std::string_view, 6> kPresetModes{"space",    "dots", "drag_dot",
                                                       "anchored", "line", "curve"};
constexpr std::array<std::string_view, 3> kPresetAlphaModes{"space", "anchored", "tiled"};

std::string quoted_name(std::string_view text) { return "\"" + std::string(text) + "\""; }

std::string listed(std::span<const std::string_view> names) {
  std::string list;
  for (const std::string_view name : names) {
    list += (list.empty() ? "" : ", ") + quoted_name(name);
  }
  return list;
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

/// Reads a preset entry by entry.
class PresetReader {
 public:
  explicit PresetReader(fs::path file) : file_(std::move(file)) {
    preset_.name = file_.stem().string();
  }

  Result<void> take(const io::SettingsEntry& entry) {
    if (!entry.section.empty()) return fail(entry, "a brush has no sections");
    for (const PresetNumber& number : kPresetNumbers) {
      if (entry.name == number.name) return take_number(entry, number);
    }
    for (const auto& [name, at] : kPresetFlags) {
      if (entry.name != name) continue;
      const bool* value = std::get_if<bool>(&entry.value);
      if (value == nullptr) return fail(entry, quoted_name(name) + " must be true or false");
      preset_.brush.*at = *value;
      return {};
    }
    return take_word(entry);
  }

  bool has_format() const noexcept { return has_format_; }
  BrushPreset take_preset() { return std::move(preset_); }

 private:
  Result<void> fail(const io::SettingsEntry& entry, const std::string& what) const {
    return io::settings_error(file_, entry, what);
  }

  Result<void> take_number(const io::SettingsEntry& entry, const PresetNumber& number) {
    const double* value = std::get_if<double>(&entry.value);
    if (value == nullptr || !(*value >= number.least && *value <= number.most)) {
      return fail(entry, quoted_name(number.name) + " must be a number from " +
                             short_number(number.least) + " to " + short_number(number.most));
    }
    preset_.brush.*number.at = *value;
    return {};
  }

  /// One of `names`, as its place.
  template <class Chosen>
  Result<void> choose_one(const io::SettingsEntry& entry, std::span<const std::string_view> names,
                          Chosen& chosen) {
    const auto* word = std::get_if<std::string>(&entry.value);
    const auto at = word == nullptr ? names.end() : std::find(names.begin(), names.end(), *word);
    if (at == names.end()) {
      return fail(entry, quoted_name(entry.name) + " must be one of " + listed(names));
    }
    chosen = static_cast<Chosen>(at - names.begin());
    return {};
  }

  Result<void> take_word(const io::SettingsEntry& entry) {
    Brush& brush = preset_.brush;
    if (entry.name == kPresetFormat) return take_format(entry);
    if (entry.name == "tool") return take_tool(entry);
    if (entry.name == "key") return take_preset_key(entry);
    if (entry.name == "shape") return choose_one(entry, kPresetShapes, brush.shape);
    if (entry.name == "falloff") return choose_one(entry, kFalloffNames, brush.falloff);
    if (entry.name == "method") return choose_one(entry, kPresetModes, brush.stroke_mode);
    if (entry.name == "emboss_method") return choose_one(entry, kPresetModes, brush.emboss_mode);
    if (entry.name == "image") return choose_one(entry, kPresetAlphaModes, brush.alpha_mode);
    if (entry.name == "seed") return take_seed(entry);
    return fail(entry,
                quoted_name(entry.name) + " is unknown; leave it out, or see docs/viewer.md");
  }

  Result<void> take_format(const io::SettingsEntry& entry) {
    if (entry.value != decltype(entry.value)(1.0)) {
      return fail(entry, "this program knows \"argil_brush\": 1; a newer one wrote the file");
    }
    has_format_ = true;
    return {};
  }

  Result<void> take_tool(const io::SettingsEntry& entry) {
    const auto* word = std::get_if<std::string>(&entry.value);
    std::vector<std::string_view> names;
    names.reserve(tool_infos().size());
    for (const ToolInfo& info : tool_infos()) {
      names.emplace_back(info.name);
      if (word == nullptr || *word != std::string_view(info.name)) continue;
      choose(preset_.brush, info);
      return {};
    }
    return fail(entry, "\"tool\" must be one of " + listed(names));
  }

  Result<void> take_preset_key(const io::SettingsEntry& entry) {
    const auto* word = std::get_if<std::string>(&entry.value);
    preset_.key = word == nullptr ? std::nullopt : chord_of(*word);
    if (preset_.key || (word != nullptr && word->empty())) return {};
    return fail(entry, "\"key\" must name a key, as \"Ctrl+1\", or be \"\" for none");
  }

  Result<void> take_seed(const io::SettingsEntry& entry) {
    const double* value = std::get_if<double>(&entry.value);
    if (value == nullptr || !(*value >= 0.0 && *value <= 99.0) || std::floor(*value) != *value) {
      return fail(entry, "\"seed\" must be a whole number from 0 to 99");
    }
    preset_.brush.seed = static_cast<int>(*value);
    return {};
  }

  fs::path file_;
  BrushPreset preset_;
  bool has_format_ = false;
};

const ToolInfo& tool_chosen(const Brush& brush) {
  const auto tools = tool_infos();
  const auto at = std::find_if(tools.begin(), tools.end(),
                               [&](const ToolInfo& info) { return is_chosen(brush, info); });
  assert(at != tools.end());
  return *at;
}

std::string preset_text(const BrushPreset& preset) {
  const Brush& brush = preset.brush;
  std::vector<io::SettingsEntry> entries;
  const auto add = [&](const char* name, decltype(io::SettingsEntry::value) value) {
    entries.push_back({"", name, std::move(value)});
  };
  const auto word_of = [](std::span<const std::string_view> names, auto chosen) {
    const auto at = static_cast<std::size_t>(chosen);
    return std::string(at < names.size() ? names[at] : names[0]);
  };
  add(kPresetFormat, 1.0);
  add("tool", std::string(tool_chosen(brush).name));
  add("key", preset.key ? text_of(*preset.key) : std::string());
  for (const PresetNumber& number : kPresetNumbers) {
    add(number.name, std::clamp(brush.*number.at, number.least, number.most));
  }
  for (const auto& [name, at] : kPresetFlags) add(name, brush.*at);
  add("shape", word_of(kPresetShapes, brush.shape));
  add("falloff", word_of(kFalloffNames, brush.falloff));
  add("method", word_of(kPresetModes, brush.stroke_mode));
  add("emboss_method", word_of(kPresetModes, brush.emboss_mode));
  add("image", word_of(kPresetAlphaModes, brush.alpha_mode));
  add("seed", static_cast<double>(std::clamp(brush.seed, 0, 99)));
  return io::settings_text(entries);
}

BrushPreset built_in(const char* name, Action action, double radius_mm, double strength) {
  BrushPreset preset;
  preset.name = name;
  preset.is_built_in = true;
  preset.brush.action = action;
  preset.brush.radius_mm = radius_mm;
  preset.brush.strength = strength;
  return preset;
}

}  // namespace

std::vector<BrushPreset> built_in_presets() {
  BrushPreset move = built_in("Big move", Action::grab, 20.0, 1.0);
  move.brush.is_screen_size = true;
  move.brush.radius_pixels = 180.0;
  BrushPreset build = built_in("Build up", Action::clay_strips, 5.0, 0.7);
  build.brush.tip_roundness = 0.4;
  BrushPreset line = built_in("Fine line", Action::crease, 1.2, 0.8);
  line.brush.width = 0.4;
  line.brush.steady_mm = 1.0;
  BrushPreset polish = built_in("Polish", Action::scrape, 8.0, 0.4);
  polish.brush.falloff = Falloff::smoother;
  BrushPreset pores = built_in("Pores", Action::noise, 6.0, 0.3);
  pores.brush.wavelength = 0.12;
  BrushPreset rivets = built_in("Rivets", Action::add, 1.5, 0.5);
  rivets.brush.spacing = 2.0;
  return {move, build, line, polish, pores, rivets};
}

fs::path preset_file(const fs::path& home, const std::string& name) {
  return home / "brushes" / (name + ".json");
}

std::string why_no_preset_name(const std::string& name) {
  if (name.empty()) return "a brush needs a name";
  if (name.size() > kMostPresetName) return "the name is too long; 60 letters are the most";
  const bool has_odd = std::any_of(name.begin(), name.end(), [](unsigned char c) {
    return c == '/' || c == '\\' || c == '#' || c < ' ' || c == 0x7F;
  });
  if (has_odd) return "a name is a file's name too: without /, \\ and #";
  return name.front() == '.' ? "a name cannot begin with a dot" : "";
}

Result<BrushPreset> read_preset(const fs::path& file) {
  const auto entries = io::read_settings_file(file);
  if (!entries) return entries.error();
  PresetReader reader(file);
  for (const io::SettingsEntry& entry : entries.value()) {
    if (auto taken = reader.take(entry); !taken) return taken.error();
  }
  if (!reader.has_format()) {
    return Error{ErrorKind::bad_input,
                 file.string() + ":1: no brush; it begins with \"argil_brush\": 1"};
  }
  return reader.take_preset();
}

Result<void> write_preset(const fs::path& home, const BrushPreset& preset) {
  assert(why_no_preset_name(preset.name).empty());
  const fs::path file = preset_file(home, preset.name);
  std::error_code error;
  fs::create_directories(file.parent_path(), error);  // what is wrong shows when it is written
  if (fs::exists(file, error) && !read_preset(file)) {
    if (auto kept = set_aside(file); !kept) return kept;
  }
  return io::replace_text(file, preset_text(preset));
}

/// One that may be written again under its name.
Result<BrushPreset> read_named_preset(const fs::path& file) {
  auto preset = read_preset(file);
  if (!preset) return preset;
  const std::string why = why_no_preset_name(preset.value().name);
  if (why.empty()) return preset;
  return Error{ErrorKind::bad_input, file.string() + ": " + why + "; rename the file"};
}

PresetList read_presets(const fs::path& home) {
  PresetList list;
  list.presets = built_in_presets();
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(home / "brushes", error)) {
    if (entry.path().extension() != ".json") continue;
    auto read = read_named_preset(entry.path());
    if (!read) {
      list.problems.push_back(read.error());
      continue;
    }
    std::erase_if(list.presets,
                  [&](const BrushPreset& one) { return one.name == read.value().name; });
    list.presets.push_back(std::move(read).value());
  }
  std::sort(list.presets.begin(), list.presets.end(),
            [](const BrushPreset& a, const BrushPreset& b) { return a.name < b.name; });
  return list;
}

Result<BrushPreset> import_preset(const fs::path& home, const fs::path& file) {
  auto preset = read_named_preset(file);
  if (!preset) return preset;
  BrushPreset& taken = preset.value();
  const std::string own_name = taken.name;
  taken.name = free_name(own_name, kMostPresetName, [&](const std::string& tried) {
    std::error_code error;
    return fs::exists(preset_file(home, tried), error) &&
           !fs::equivalent(preset_file(home, tried), file, error);
  });
  if (auto written = write_preset(home, taken); !written) return written.error();
  return preset;
}

bool looks_like_preset(const fs::path& file) {
  if (file.extension() != ".json") return false;
  const auto entries = io::read_settings_file(file);
  if (!entries) return true;  // reading it says what is wrong
  return std::any_of(entries.value().begin(), entries.value().end(),
                     [](const io::SettingsEntry& entry) { return entry.name == kPresetFormat; });
}

void apply(const BrushPreset& preset, Brush& brush) noexcept {
  const Brush former = brush;
  brush = preset.brush;
  brush.mirror = former.mirror;
  brush.radial = former.radial;
  brush.alpha = former.alpha;
  brush.mesh = former.mesh;
}

bool is_applied(const BrushPreset& preset, const Brush& brush) {
  BrushPreset now = preset;
  now.brush = brush;
  // A mesh would be written as another shape.
  return brush.shape != Shape::mesh && preset_text(now) == preset_text(preset);
}

}  // namespace argil::viewer
