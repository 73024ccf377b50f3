// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands/import_choice.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "argil/engine/clay_options.h"
#include "argil/io/prepared_mesh.h"

namespace argil::viewer {
namespace {

double largest(const Vec3& size) { return std::max({size.x, size.y, size.z}); }

/// To two digits.
double rounded(double value) {
  assert(value > 0.0);
  const double step = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::round(value / step) * step;
}

void propose_voxel(ImportChoice& choice, const MeshOffer& offer) {
  if (choice.has_own_voxel) return;
  choice.voxel_mm = std::clamp(rounded(largest(size_of(choice, offer)) / io::kUsualResolution),
                               kLeastVoxelMm, kMostVoxelMm);
}

/// Of the mesh as the offer has it, in the frame that was chosen.
double factor_of(const ImportChoice& choice, const MeshOffer& offer) {
  return choice.scale * io::length_mm(choice.unit) / io::length_mm(offer.frame.unit);
}

}  // namespace

void fill(ImportChoice& choice, const MeshOffer& offer) {
  const io::FrameReport& frame = offer.frame;
  choice.is_filled = true;
  choice.unit = frame.unit_looks_like.value_or(frame.unit);
  choice.up = frame.up_looks_like.value_or(frame.up);
  choice.guesses.clear();
  const std::string unit = io::unit_name(choice.unit);
  const std::string axis = choice.up == io::UpAxis::y ? "y" : "z";
  if (frame.unit_looks_like) {
    choice.guesses.push_back("Unit: a guess by its size, " + unit + ".");
  } else if (frame.unit_source == io::FrameSource::assumed) {
    choice.guesses.push_back("Unit: the file names none, so " + unit + ".");
  }
  if (frame.up_looks_like) {
    choice.guesses.push_back("Up: a guess by how it stands, " + axis + ".");
  }
  propose_voxel(choice, offer);
}

Vec3 size_of(const ImportChoice& choice, const MeshOffer& offer) {
  Vec3 size = factor_of(choice, offer) * offer.size_mm;
  if (choice.up != offer.frame.up) std::swap(size.y, size.z);
  return size;
}

void set_size(ImportChoice& choice, const MeshOffer& offer, std::size_t axis, double mm) {
  assert(axis < 3 && mm >= 0.0);
  const Vec3 size = size_of(choice, offer);
  if (!(size[axis] > 0.0)) return;  // flat along it
  // The longest side stays in the range of what can be imported.
  const double wanted = largest(size) * mm / size[axis];
  choice.scale *= std::clamp(wanted, kLeastImportMm, kMostImportMm) / largest(size);
  propose_voxel(choice, offer);
}

void set_unit(ImportChoice& choice, const MeshOffer& offer, io::LengthUnit unit) {
  choice.unit = unit;
  choice.scale = 1.0;
  propose_voxel(choice, offer);
}

void set_voxel(ImportChoice& choice, double mm) {
  choice.voxel_mm = mm;
  choice.has_own_voxel = true;
}

io::ImportOutlook::Cost cost_of(const ImportChoice& choice, const MeshOffer& offer) {
  const double voxels = largest(size_of(choice, offer)) / choice.voxel_mm;
  return offer.outlook.at(std::max(1.0, voxels));
}

ImportMesh request_of(const ImportChoice& choice, const MeshOffer& offer) {
  ImportMesh wanted;
  wanted.file = offer.file;
  wanted.how.preparation.repairs = choice.repairs;
  wanted.how.preparation.frame = {choice.unit, choice.up};
  // As large as the file says keeps its bits.
  if (choice.scale != 1.0) wanted.how.preparation.size_mm = largest(size_of(choice, offer));
  wanted.how.voxel_mm = choice.voxel_mm;
  wanted.how.keeps_parts = choice.keeps_parts && offer.parts > 1;
  return wanted;
}

}  // namespace argil::viewer
