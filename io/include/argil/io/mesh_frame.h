// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"

namespace argil::io {

/// The unit of a mesh file's numbers. Micrometres and feet are units of 3MF alone.
enum class LengthUnit { um, mm, cm, m, in, ft };
double length_mm(LengthUnit unit) noexcept;
/// "mm", as the enumerator.
const char* unit_name(LengthUnit unit) noexcept;

/// The axis of a mesh file that points up. Argil's is z, as a printer's.
enum class UpAxis { y, z };

/// How a mesh file is to be understood; what is not said is as the file states, else mm and z up.
/// What is said counts more than what a file states: many a GLB holds millimetres.
struct MeshFrame {
  std::optional<LengthUnit> unit;
  std::optional<UpAxis> up;
};

/// Who said it: the caller, the file, or nobody.
enum class FrameSource { given, file, assumed };

/// How a mesh file was understood.
struct FrameReport {
  LengthUnit unit = LengthUnit::mm;
  FrameSource unit_source = FrameSource::assumed;
  /// Where nobody said, and the size speaks against the unit: what would give a piece of usual
  /// size. A GLB's metres are doubted, too, where it is larger than any printer.
  std::optional<LengthUnit> unit_looks_like;
  UpAxis up = UpAxis::z;
  FrameSource up_source = FrameSource::assumed;
  /// Where nobody said, and the mesh stands along y: on a flat side, or on the plane y = 0 with its
  /// middle over the origin.
  std::optional<UpAxis> up_looks_like;
  double largest_side_mm = 0.0;
};

struct FramedMesh {
  TriangleMesh mesh;  ///< in mm, z up
  FrameReport frame;
};

/// As read_mesh (mesh_file.h), in the units and axes that are wanted: numbers are multiplied by the
/// unit, and y up becomes z up by a quarter turn about x. Without a word on either, the bits are
/// those of read_mesh: guesses are only told.
Result<FramedMesh> read_framed_mesh(const std::filesystem::path& file,
                                    const MeshFrame& wanted = {});

/// Each guess of a report as a sentence that names the remedy; none where nothing is doubted.
std::vector<std::string> frame_doubts(const std::filesystem::path& file, const FrameReport& frame);

}  // namespace argil::io
