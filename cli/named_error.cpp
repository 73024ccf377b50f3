// SPDX-License-Identifier: GPL-3.0-or-later
#include "named_error.h"

#include <string>

namespace argil::cli {

Error named(const std::filesystem::path& file, Error error) {
  const bool is_of_file = error.kind != ErrorKind::disk && error.kind != ErrorKind::interrupted;
  if (is_of_file && error.message.find(file.string()) == std::string::npos) {
    error.message = "'" + file.string() + "': " + error.message;
  }
  return error;
}

}  // namespace argil::cli
