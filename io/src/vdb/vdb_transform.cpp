// SPDX-License-Identifier: GPL-3.0-or-later
// Maps of cubic voxels in all forms that OpenVDB writes them in: it chooses one that is as short as
// can be.
#include "vdb/vdb_transform.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <sstream>
#include <string>

#include "argil/engine/clay_options.h"

namespace argil::io {
namespace {

using openvdb::math::Transform;

/// How the map of a transform is written: first what it is made of, then what follows from that.
struct MapForm {
  std::string_view name;
  std::size_t numbers;
  bool has_shift;
  bool has_scale;
};
/// OpenVDB writes a linear map in the first of these forms that holds it.
constexpr std::array kForms{MapForm{"UniformScaleMap", 15, false, true},
                            MapForm{"ScaleMap", 15, false, true},
                            MapForm{"TranslationMap", 3, true, false},
                            MapForm{"UniformScaleTranslateMap", 18, true, true},
                            MapForm{"ScaleTranslateMap", 18, true, true},
                            MapForm{"AffineMap", 16, false, false}};
constexpr double kMostVoxel = 1e9;

const MapForm* form_of(std::string_view name) {
  const auto found = std::find_if(kForms.begin(), kForms.end(),
                                  [name](const MapForm& form) { return form.name == name; });
  return found == kForms.end() ? nullptr : &*found;
}

double number_at(std::string_view bytes, std::size_t n) {
  double value = 0.0;
  std::memcpy(&value, bytes.data() + n * sizeof value, sizeof value);
  return value;
}

/// The images of the three unit vectors, then of the origin.
using MapRows = std::array<Vec3, 4>;

MapRows rows_in(const MapForm& form, std::string_view bytes) {
  MapRows rows{Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 1.0, 0.0}, Vec3{0.0, 0.0, 1.0}, Vec3{}};
  if (!form.has_shift && !form.has_scale) {
    for (std::size_t r = 0; r < rows.size(); ++r) {
      for (std::size_t c = 0; c < 3; ++c) rows[r][c] = number_at(bytes, 4 * r + c);
    }
    return rows;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    if (form.has_shift) rows[3][c] = number_at(bytes, c);
    if (form.has_scale) rows[c][c] = number_at(bytes, c + (form.has_shift ? 3 : 0));
  }
  return rows;
}

/// OpenVDB throws at voxels of less than 1.44e-5; no clay has less than kLeastVoxelMm.
bool are_of_cubes(const MapRows& rows) {
  if (!std::all_of(rows.begin(), rows.end(), [](const Vec3& row) { return is_finite(row); })) {
    return false;
  }
  const double voxel = length(rows[0]);
  if (!(voxel >= kLeastVoxelMm && voxel < kMostVoxel)) return false;
  constexpr double kRounding = 1e-9;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t s = r; s < 3; ++s) {
      const double must = r == s ? 1.0 : 0.0;
      if (!(std::abs(dot(rows[r], rows[s]) / (voxel * voxel) - must) < kRounding)) return false;
    }
  }
  return true;
}

/// In the first form that holds it.
Transform::Ptr transform_of(const MapRows& rows) {
  const auto& [x, y, z, at] = rows;
  return Transform::createLinearTransform(openvdb::math::Mat4d(
      x.x, x.y, x.z, 0.0, y.x, y.y, y.z, 0.0, z.x, z.y, z.z, 0.0, at.x, at.y, at.z, 1.0));
}

bool is_written_as(const Transform& transform, std::string_view name, std::string_view bytes) {
  std::ostringstream text;
  transform.write(text);
  return transform.mapType() == name && text.view().ends_with(bytes);
}

}  // namespace

Transform::Ptr grid_transform(double voxel_mm, const Placement& placement) {
  assert(voxel_mm >= kLeastVoxelMm);
  const Vec3& at = placement.position_mm;
  const Quat& q = placement.orientation;
  if (at == Vec3{} && q == Quat{}) return Transform::createLinearTransform(voxel_mm);
  return transform_of({voxel_mm * rotate(q, {1.0, 0.0, 0.0}), voxel_mm * rotate(q, {0.0, 1.0, 0.0}),
                       voxel_mm * rotate(q, {0.0, 0.0, 1.0}), at});
}

std::optional<std::size_t> map_bytes(std::string_view name) {
  const MapForm* form = form_of(name);
  if (form == nullptr) return std::nullopt;
  return form->numbers * sizeof(double);
}

Transform::Ptr read_map(std::string_view name, std::string_view bytes) {
  assert(map_bytes(name) == bytes.size());
  const MapRows rows = rows_in(*form_of(name), bytes);
  if (!are_of_cubes(rows)) return nullptr;
  Transform::Ptr read = transform_of(rows);
  // Others would be taken for cubic voxels of another size.
  return is_written_as(*read, name, bytes) ? read : nullptr;
}

}  // namespace argil::io
