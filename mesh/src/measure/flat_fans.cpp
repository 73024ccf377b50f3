// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/flat_fans.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <span>

#include <tbb/parallel_for.h>

#include "argil/mesh/triangle_geometry.h"

#include "topology/corners_around.h"

namespace argil::mesh {
namespace {

/// The ring of one vertex: behind next[i] the triangle turns to next[i + 1].
class Fan {
 public:
  Fan(const TriangleMesh& mesh, std::uint32_t v) : mesh_(mesh), v_(v), at_(mesh.positions[v]) {}

  bool is_flat(std::span<const std::uint32_t> around) {
    return find_sides(around) && is_one_ring() && turns_once();
  }

 private:
  static constexpr std::size_t kMost = 24;  // triangles; those of more are looked at by pairs

  bool find_sides(std::span<const std::uint32_t> around);
  bool is_one_ring() const noexcept;
  bool turns_once() const noexcept;
  Vec3 to(std::uint32_t v) const noexcept { return mesh_.positions[v] - at_; }

  const TriangleMesh& mesh_;
  std::uint32_t v_;
  const Vec3& at_;
  std::size_t count_ = 0;
  std::array<std::uint32_t, kMost> from_{};  ///< of each triangle the corner behind the vertex,
  std::array<std::uint32_t, kMost> to_{};    ///< and the one before it
};

bool Fan::find_sides(std::span<const std::uint32_t> around) {
  if (around.size() < 3 || around.size() > kMost) return false;
  for (const std::uint32_t corner : around) {
    const Triangle& t = mesh_.triangles[corner / 3];
    const std::size_t k = corner % 3;
    assert(t[k] == v_);
    from_[count_] = t[(k + 1) % 3];
    to_[count_] = t[(k + 2) % 3];
    if (from_[count_] == v_ || to_[count_] == v_) return false;
    ++count_;
  }
  return true;
}

bool Fan::is_one_ring() const noexcept {
  std::uint32_t end = to_[0];
  for (std::size_t steps = 1; steps < count_; ++steps) {
    if (end == from_[0]) return false;  // closed before all were met
    std::size_t next = 1;
    while (next < count_ && from_[next] != end) ++next;
    if (next == count_) return false;
    end = to_[next];
  }
  return end == from_[0];
}

/// Whether all turn the same way in the plane that is seen along the axis which their normals have
/// most of, and once around in all.
bool Fan::turns_once() const noexcept {
  Vec3 normal;
  for (std::size_t i = 0; i < count_; ++i) normal += cross(to(from_[i]), to(to_[i]));
  std::size_t axis = 0;
  for (std::size_t k = 1; k < 3; ++k) {
    if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
  }
  const double side = normal[axis] > 0.0 ? 1.0 : -1.0;
  const std::size_t x = (axis + 1) % 3;
  const std::size_t y = (axis + 2) % 3;
  int turns = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    const Vec3& a = mesh_.positions[from_[i]];
    const Vec3& b = mesh_.positions[to_[i]];
    const double left = (a[x] - at_[x]) * (b[y] - at_[y]);
    const double right = (a[y] - at_[y]) * (b[x] - at_[x]);
    // J. Shewchuk, "Adaptive precision floating-point arithmetic", 1997: 3 + 16 eps times 2^-53;
    // and what is so small that it may have lost its digits is not known.
    constexpr double kRounding = 3.5e-16;
    constexpr double kLeast = 1e-280;
    const double sum = std::abs(left) + std::abs(right);
    if (!(side * (left - right) > kRounding * sum && sum > kLeast)) return false;
    // One way round a ring comes from below the vertex to above once; the other way it goes.
    turns += (a[y] < at_[y]) && !(b[y] < at_[y]) ? 1 : 0;
  }
  return turns == 1;
}

}  // namespace

std::vector<std::uint8_t> flat_fans(const TriangleMesh& mesh, const Pace& pace) {
  constexpr std::size_t kBlock = 2048;
  constexpr std::size_t kBetweenReports = 256 * kBlock;
  pace.at(0.0);
  const CornersAround around(mesh);
  const std::size_t count = mesh.positions.size();
  std::vector<std::uint8_t> is_flat(count, 0);
  for (std::size_t first = 0; first < count; first += kBetweenReports) {
    pace.at(static_cast<double>(first) / static_cast<double>(count));
    const std::size_t end = std::min(count, first + kBetweenReports);
    tbb::parallel_for(std::size_t{0}, (end - first + kBlock - 1) / kBlock, [&](std::size_t block) {
      const std::size_t stop = std::min(end, first + (block + 1) * kBlock);
      for (std::size_t v = first + block * kBlock; v < stop; ++v) {
        Fan fan(mesh, static_cast<std::uint32_t>(v));
        is_flat[v] = fan.is_flat(around.of(v)) ? 1 : 0;
      }
    });
  }
  return is_flat;
}

}  // namespace argil::mesh
