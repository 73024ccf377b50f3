// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings.h"

#include <fstream>
#include <system_error>

#include "argil/io/safe_file.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "settings.txt";
constexpr const char* kNumberViews = "number_views";
constexpr const char* kPrinter = "printer";
constexpr const char* kFirmware = "falcon_firmware";

}  // namespace

Settings read_settings(const fs::path& home) {
  Settings settings;
  std::ifstream in(home / kFile);
  for (std::string line; std::getline(in, line);) {
    const std::size_t blank = line.find(' ');
    if (blank == std::string::npos) continue;
    const std::string name = line.substr(0, blank);
    const std::string value = line.substr(blank + 1);
    if (name == kNumberViews) settings.has_number_views = value == "1";
    if (name == kPrinter) settings.printer = value;
    if (name == kFirmware) settings.firmware = value;
  }
  return settings;
}

Result<void> write_settings(const fs::path& home, const Settings& settings) {
  std::error_code error;
  fs::create_directories(home, error);  // what is wrong shows when the file is written
  return io::replace_file(home / kFile, [&](const fs::path& temporary) {
    std::ofstream out(temporary);
    out << kNumberViews << ' ' << (settings.has_number_views ? 1 : 0) << '\n';
    if (!settings.printer.empty()) out << kPrinter << ' ' << settings.printer << '\n';
    if (!settings.firmware.empty()) {
      out << kFirmware << ' ' << settings.firmware.string() << '\n';
    }
    if (out.flush()) return Result<void>();
    return Result<void>(Error{ErrorKind::disk, "cannot write the settings"});
  });
}

}  // namespace argil::viewer
