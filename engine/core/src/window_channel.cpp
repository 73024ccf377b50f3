// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/core/window_channel.h"

#include "argil/core/hash.h"

namespace argil {

std::uint64_t window_checksum(const FieldWindowView& view) noexcept {
  // Field by field, since bytes between members have no fixed value.
  Hash64 hash;
  const std::array<double, 5> frame{view.origin_mm.x, view.origin_mm.y, view.origin_mm.z,
                                    view.voxel_mm, view.distance_error_mm};
  const std::array<int, 4> shape{view.nodes[0], view.nodes[1], view.nodes[2], view.level};
  hash.update(std::as_bytes(std::span(frame)));
  hash.update(std::as_bytes(std::span(shape)));
  hash.update(std::as_bytes(view.distance_mm));
  return hash.digest();
}

}  // namespace argil
