// SPDX-License-Identifier: GPL-3.0-or-later
#include "vdb/grid_archive.h"

#include <cerrno>
#include <fstream>

#include <openvdb/io/Archive.h>

#include "file/file_bytes.h"

namespace argil::io {
namespace {

/// Archive::write is protected. A stream of our own says whether the disk took everything, which
/// openvdb::io::File does not.
class CheckedArchive : public openvdb::io::Archive {
 public:
  Result<void> save(const std::filesystem::path& file, const VdbGrid::Ptr& grid) const {
    std::ofstream out(file, std::ios::binary | std::ios::trunc);
    errno = 0;
    write(out, openvdb::GridCPtrVec{grid}, true);
    out.close();
    if (!out) return disk_error("write", file, errno != 0 ? errno : EIO);
    return {};
  }
};

}  // namespace

Result<void> write_grid(const std::filesystem::path& file, const VdbGrid::Ptr& grid) {
  return CheckedArchive().save(file, grid);
}

}  // namespace argil::io
