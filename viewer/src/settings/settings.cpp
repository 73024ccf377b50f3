// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/settings.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <system_error>

#include "argil/io/safe_file.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "settings.txt";
constexpr const char* kNumberViews = "number_views";
constexpr const char* kPanelPercent = "panel_percent";
constexpr const char* kPressure = "pressure_curve";
constexpr const char* kTheme = "theme";
constexpr const char* kPrinter = "printer";
constexpr const char* kFirmware = "falcon_firmware";
constexpr const char* kUnasked = "unasked";
constexpr const char* kRecentFile = "recent.txt";
constexpr std::size_t kMostRecent = 10;

/// The file's content: "NAME VALUE" a line, empty values left out.
std::string lines_of(const Settings& settings) {
  std::string lines;
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) lines.append(name).append(" ").append(value).append("\n");
  };
  add(kNumberViews, settings.has_number_views ? "1" : "0");
  add(kPanelPercent, std::to_string(settings.panel_percent));
  if (settings.pressure != PressureCurve()) add(kPressure, text_of(settings.pressure));
  if (settings.theme != Theme::dark) {
    add(kTheme, std::string(kThemeNames[static_cast<std::size_t>(settings.theme)]));
  }
  add(kPrinter, settings.printer);
  add(kFirmware, settings.firmware.string());
  for (const std::string& one : settings.unasked) add(kUnasked, one);
  return lines;
}

/// Within the range of kPanelPercents; 100 for what is no number.
int percent_of(const std::string& value) {
  int percent = 100;
  std::from_chars(value.data(), value.data() + value.size(), percent);
  return std::clamp(percent, kPanelPercents.front(), kPanelPercents.back());
}

/// Replaces the file whole, so that another window never reads half of it.
Result<void> write_lines(const fs::path& home, const char* name, const std::string& lines) {
  std::error_code error;
  fs::create_directories(home, error);  // what is wrong shows when the file is written
  return io::replace_text(home / name, lines);
}

}  // namespace

Settings read_settings(const fs::path& home) {
  // Names that are not known are skipped, so that an older program reads a newer file.
  Settings settings;
  std::ifstream in(home / kFile);
  for (std::string line; std::getline(in, line);) {
    const std::size_t blank = line.find(' ');
    if (blank == std::string::npos) continue;
    const std::string name = line.substr(0, blank);
    const std::string value = line.substr(blank + 1);
    if (name == kNumberViews) settings.has_number_views = value == "1";
    if (name == kPanelPercent) settings.panel_percent = percent_of(value);
    if (name == kPressure) settings.pressure = pressure_of(value).value_or(PressureCurve());
    if (name == kTheme && value == kThemeNames[1]) settings.theme = Theme::light;
    if (name == kPrinter) settings.printer = value;
    if (name == kFirmware) settings.firmware = value;
    if (name == kUnasked && !value.empty()) settings.unasked.push_back(value);
  }
  return settings;
}

Result<void> write_changes(const fs::path& home, const Settings& before, const Settings& after) {
  // Read anew: what another window changed meanwhile is kept where this one changed nothing.
  Settings settings = read_settings(home);
  if (after.has_number_views != before.has_number_views) {
    settings.has_number_views = after.has_number_views;
  }
  if (after.panel_percent != before.panel_percent) settings.panel_percent = after.panel_percent;
  if (after.pressure != before.pressure) settings.pressure = after.pressure;
  if (after.theme != before.theme) settings.theme = after.theme;
  if (after.printer != before.printer) settings.printer = after.printer;
  if (after.firmware != before.firmware) settings.firmware = after.firmware;
  if (after.unasked != before.unasked) settings.unasked = after.unasked;
  return write_lines(home, kFile, lines_of(settings));
}

std::vector<fs::path> read_recent(const fs::path& home) {
  std::vector<fs::path> files;
  std::ifstream in(home / kRecentFile);
  for (std::string line; std::getline(in, line) && files.size() < kMostRecent;) {
    if (!line.empty()) files.emplace_back(line);
  }
  return files;
}

namespace {

Result<void> write_recent_files(const fs::path& home, const std::vector<fs::path>& recent) {
  std::string lines;
  for (const fs::path& name : recent) lines.append(name.string()).append("\n");
  return write_lines(home, kRecentFile, lines);
}

}  // namespace

Result<void> add_recent(const fs::path& home, const fs::path& file, std::vector<fs::path>& recent) {
  recent = read_recent(home);
  std::erase(recent, file);
  recent.insert(recent.begin(), file);
  if (recent.size() > kMostRecent) recent.resize(kMostRecent);
  return write_recent_files(home, recent);
}

Result<void> remove_recent(const fs::path& home, const fs::path& file,
                           std::vector<fs::path>& recent) {
  recent = read_recent(home);
  std::erase(recent, file);
  return write_recent_files(home, recent);
}

}  // namespace argil::viewer
