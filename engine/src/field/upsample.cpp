// SPDX-License-Identifier: GPL-3.0-or-later
#include "field/upsample.h"

#include <cassert>
#include <cstddef>
#include <cstring>

namespace argil {

void clamp_to(float band, LeafValues& values) noexcept {
  for (float& v : values) v = v < -band ? -band : (v > band ? band : v);
}

/// x, then y, then z: 5^3 nodes become 8 x 5 x 5, 8 x 8 x 5 and 8^3.
void upsample(const CoarseNodes& coarse, LeafValues& out) {
  const auto mid = [](float a, float b) { return 0.5F * (a + b); };
  std::array<float, 8 * 25> along_x{};
  std::array<float, 8 * 8 * 5> along_y{};
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t jk = 0; jk < 25; ++jk) {
      const float a = coarse[(i / 2) * 25 + jk];
      along_x[i * 25 + jk] = i % 2 == 0 ? a : mid(a, coarse[(i / 2 + 1) * 25 + jk]);
    }
  }
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = 0; j < 8; ++j) {
      for (std::size_t k = 0; k < 5; ++k) {
        const float a = along_x[i * 25 + (j / 2) * 5 + k];
        along_y[(i * 8 + j) * 5 + k] =
            j % 2 == 0 ? a : mid(a, along_x[i * 25 + (j / 2 + 1) * 5 + k]);
      }
    }
  }
  for (std::size_t ij = 0; ij < 64; ++ij) {
    for (std::size_t k = 0; k < 8; ++k) {
      const float a = along_y[ij * 5 + k / 2];
      out[ij * 8 + k] = k % 2 == 0 ? a : mid(a, along_y[ij * 5 + k / 2 + 1]);
    }
  }
}

namespace {

/// 1 to 8 floats, without a call: by two copies that may overlap.
void copy_run(const float* from, std::size_t count, float* to) noexcept {
  if (count >= 4) {
    std::memcpy(to, from, 4 * sizeof(float));
    std::memcpy(to + count - 4, from + count - 4, 4 * sizeof(float));
  } else {
    to[0] = from[0];
    to[count / 2] = from[count / 2];
    to[count - 1] = from[count - 1];
  }
}

}  // namespace

void copy_into_box(const Coord& origin, const float* values, const openvdb::CoordBBox& box,
                   std::vector<float>& out) {
  const Coord dim = box.dim();
  const Coord lo = Coord::maxComponent(origin, box.min());
  const Coord hi = Coord::minComponent(origin.offsetBy(kLeafSide - 1), box.max());
  assert(lo.x() <= hi.x() && lo.y() <= hi.y() && lo.z() <= hi.z());  // they have nodes in common
  assert(out.size() == static_cast<std::size_t>(box.volume()));
  const auto run = static_cast<std::size_t>(hi.z() - lo.z() + 1);
  for (int x = lo.x(); x <= hi.x(); ++x) {
    for (int y = lo.y(); y <= hi.y(); ++y) {
      const Coord at = Coord(x, y, lo.z()) - box.min();
      const auto to = (static_cast<std::size_t>(at.x()) * static_cast<std::size_t>(dim.y()) +
                       static_cast<std::size_t>(at.y())) *
                          static_cast<std::size_t>(dim.z()) +
                      static_cast<std::size_t>(at.z());
      copy_run(values + leaf_offset(Coord(x, y, lo.z())), run, &out[to]);
    }
  }
}

}  // namespace argil
