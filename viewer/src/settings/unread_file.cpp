// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/unread_file.h"

#include <string>
#include <system_error>

#include "base/text.h"

namespace argil::viewer {

namespace fs = std::filesystem;

Result<void> set_aside(const fs::path& file) {
  std::error_code error;
  fs::path aside = file;
  aside += ".unread";
  for (int n = 2; fs::exists(fs::symlink_status(aside, error)); ++n) {
    aside = file;
    aside += ".unread-" + std::to_string(n);
  }
  fs::rename(file, aside, error);
  if (!error) return {};
  return Error{ErrorKind::disk, file.string() + " cannot be read, nor be kept as " +
                                    in_quotes(aside.filename().string()) + " (" + error.message() +
                                    "), so nothing was written over it; move it away"};
}

}  // namespace argil::viewer
