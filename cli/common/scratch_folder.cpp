// SPDX-License-Identifier: GPL-3.0-or-later
// A folder for temporary files, removed together with its object.
#include "common/scratch_folder.h"

#include <cerrno>
#include <system_error>

#include <stdlib.h>

namespace argil::cli {

Result<ScratchFolder> ScratchFolder::make() {
  std::error_code error;
  const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  std::string name = (parent / "argil-XXXXXX").string();
  if (!error && ::mkdtemp(name.data()) != nullptr) return ScratchFolder(name);
  const int failed_with = error ? error.value() : errno;
  return Error{ErrorKind::disk, "cannot make a folder in '" + parent.string() + "' (" +
                                    std::generic_category().message(failed_with) +
                                    "); name another folder in TMPDIR"};
}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace argil::cli
