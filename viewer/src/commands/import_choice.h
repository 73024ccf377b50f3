// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "document/mesh_offer.h"
#include "document/request.h"

namespace argil::viewer {

/// The dialog about a mesh that is to be imported, from the moment it is named.
struct ImportChoice {
  std::filesystem::path file;
  std::int64_t number = 0;  ///< of the offer that is waited for, or was taken
  bool is_filled = false;   ///< what follows is of that offer
  io::LengthUnit unit = io::LengthUnit::mm;
  io::UpAxis up = io::UpAxis::z;
  double scale = 1.0;  ///< of the mesh in that unit
  double voxel_mm = 0.25;
  bool has_own_voxel = false;  ///< it was typed: another size leaves it alone
  bool repairs = true;
  bool keeps_parts = false;
  std::vector<std::string> guesses;  ///< what was taken for granted, in sentences
};

/// Sizes of a mesh that can be imported: as io::read_prepared_mesh has it.
inline constexpr double kLeastImportMm = 0.01;
inline constexpr double kMostImportMm = 10'000.0;

/// What is proposed for a mesh: its unit and axis as the file says, or as its size and stand look
/// like where nobody said; and voxels as `argil import` takes them, rounded to two digits.
void fill(ImportChoice& choice, const MeshOffer& offer);

/// Width, depth and height in mm as they were chosen, z up.
Vec3 size_of(const ImportChoice& choice, const MeshOffer& offer);
/// Makes one of these so long; the others keep their proportion to it.
void set_size(ImportChoice& choice, const MeshOffer& offer, std::size_t axis, double mm);
/// The unit of the file's numbers. The size is what it then is.
void set_unit(ImportChoice& choice, const MeshOffer& offer, io::LengthUnit unit);
void set_voxel(ImportChoice& choice, double mm);

/// How much clay it will be.
io::ImportOutlook::Cost cost_of(const ImportChoice& choice, const MeshOffer& offer);

/// What the document thread is asked for.
ImportMesh request_of(const ImportChoice& choice, const MeshOffer& offer);

}  // namespace argil::viewer
