// SPDX-License-Identifier: GPL-3.0-or-later
// The certificate of an export as pairs of name and value, which 3MF stores as metadata.
#include "argil/mesh/certificate.h"

#include <array>
#include <charconv>

#include "argil/core/hash_text.h"

namespace argil::mesh {
namespace {

/// The shortest text that reads back as the same number, whatever the locale.
template <class Number>
std::string text_of(Number value) {
  std::array<char, 32> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  return {digits.data(), end};
}

}  // namespace

std::vector<std::pair<std::string, std::string>> metadata_of(const Certificate& certificate) {
  std::vector<std::pair<std::string, std::string>> all;
  // Names beyond those that 3MF lists need a namespace (core specification, metadata).
  const auto add = [&](const std::string& name, std::string value) {
    all.emplace_back("argil:" + name, std::move(value));
  };
  const auto add_distances = [&](const std::string& name, const DistanceSummary& d) {
    add(name + "_max_mm", text_of(d.max_mm));
    add(name + "_mean_mm", text_of(d.mean_mm));
    add(name + "_rms_mm", text_of(d.rms_mm));
    add(name + "_samples", text_of(d.samples));
  };
  add("units", "mm");
  add_distances("mesh_to_field", certificate.error.mesh_to_field);
  add_distances("field_to_mesh", certificate.error.field_to_mesh);
  add("volume_change", text_of(certificate.volume_change));
  add("triangles", text_of(certificate.triangles));
  add("surface_triangles", text_of(certificate.surface_triangles));
  add("voxel_mm", text_of(certificate.voxel_mm));
  add("tolerance_voxels", text_of(certificate.tolerance_voxels));
  if (certificate.proven_max_mm > 0.0) add("proven_max_mm", text_of(certificate.proven_max_mm));
  if (certificate.asked_max_error_mm > 0.0) {
    add("asked_max_error_mm", text_of(certificate.asked_max_error_mm));
  }
  if (certificate.asked_triangles > 0) {
    add("asked_triangles", text_of(certificate.asked_triangles));
  }
  add("clay_hash", hash_text(certificate.clay_hash));
  return all;
}

}  // namespace argil::mesh
