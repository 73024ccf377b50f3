// SPDX-License-Identifier: GPL-3.0-or-later
#include "vdb/vdb_write.h"

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
  Result<void> save(const std::filesystem::path& file, const openvdb::GridCPtrVec& grids,
                    const openvdb::MetaMap& meta) const {
    std::ofstream out(file, std::ios::binary | std::ios::trunc);
    errno = 0;
    write(out, grids, true, meta);
    out.close();
    if (!out) return disk_error("write", file, errno != 0 ? errno : EIO);
    return {};
  }
};

}  // namespace

Result<void> write_vdb(const std::filesystem::path& file, const openvdb::GridCPtrVec& grids,
                       const openvdb::MetaMap& meta) {
  return CheckedArchive().save(file, grids, meta);
}

}  // namespace argil::io
