// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/printer_list.h"

#include <algorithm>
#include <cassert>
#include <fstream>
#include <map>
#include <system_error>

#include "argil/io/printer_file.h"
#include "argil/io/safe_file.h"

namespace argil::viewer {
namespace {

namespace fs = std::filesystem;

/// Dear ImGui does not show what follows "##" in a label: a blank keeps the two apart.
std::string as_shown(std::string name) {
  for (std::size_t at = 0; (at = name.find("##", at)) != std::string::npos; ++at) {
    name.insert(at + 1, 1, ' ');
  }
  return name;
}

/// Printers of one name get their file's name behind it.
void tell_apart(std::vector<mesh::Printer>& printers, const std::vector<std::string>& files) {
  assert(printers.size() == files.size());
  std::map<std::string, int> times;
  for (const mesh::Printer& printer : printers) ++times[printer.name];
  for (std::size_t n = 0; n < printers.size(); ++n) {
    if (times[printers[n].name] > 1) printers[n].name += " (" + as_shown(files[n]) + ")";
  }
}

}  // namespace

PrinterList read_printers(const fs::path& home) {
  PrinterList list;
  const fs::path folder = home / "printers";
  std::error_code error;
  fs::create_directories(folder, error);  // what is wrong shows when a file is written
  // Only those that are missing: what was changed stays, and what was removed comes back.
  for (const auto& [name, content] : built_in_profiles()) {
    if (fs::exists(folder / name, error)) continue;
    if (auto written = io::replace_text(folder / name, content); !written) {
      list.problems.push_back(written.error());
    }
  }
  std::vector<std::string> files;  // of each printer
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() != ".json") continue;
    auto read = io::read_printer(entry.path());
    if (read) {
      list.printers.push_back(std::move(read).value());
      list.printers.back().name = as_shown(std::move(list.printers.back().name));
      files.push_back(entry.path().stem().string());
    } else {
      list.problems.push_back(read.error());
    }
  }
  tell_apart(list.printers, files);
  std::sort(list.printers.begin(), list.printers.end(),
            [](const mesh::Printer& a, const mesh::Printer& b) { return a.name < b.name; });
  return list;
}

}  // namespace argil::viewer
