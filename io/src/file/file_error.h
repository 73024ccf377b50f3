// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "argil/core/result.h"

namespace argil::io {

/// An error of the form "'FILE'WHAT".
inline Error file_error(ErrorKind kind, const std::filesystem::path& file, std::string_view what) {
  std::string message(1, '\'');
  return {kind, message.append(file.string()).append("'").append(what)};
}

}  // namespace argil::io
