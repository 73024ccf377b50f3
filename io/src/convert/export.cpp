// SPDX-License-Identifier: GPL-3.0-or-later
// Extracts, decimates and measures, writes to a temporary file, reads that back and checks it: the
// verdict is on what the reader of the file gets. Only then does the file get its name.
#include "argil/io/export.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "argil/core/no_throw.h"
#include "argil/engine/surface.h"
#include "argil/io/mesh_file.h"
#include "argil/io/safe_file.h"
#include "argil/mesh/bodies.h"
#include "argil/mesh/check.h"
#include "argil/mesh/collapse_folded.h"
#include "argil/mesh/rounding.h"
#include "argil/mesh/small_components.h"

#include "compare/extracted_surface.h"
#include "compare/field_error.h"
#include "compare/surface_near.h"
#include "convert/decimate_extracted.h"
#include "file/file_bytes.h"
#include "mesh_format/mesh_write.h"

namespace argil::io {
namespace {

class Export {
 public:
  Export(const std::filesystem::path& file, const Clay& clay, const ExportOptions& options,
         const Progress& progress)
      : file_(file), clay_(clay), options_(options), pace_(progress, "export") {}

  Result<ExportReport> run();

 private:
  bool removes_triangles() const { return options_.max_error_mm != 0.0 || options_.triangles != 0; }
  /// A stage's part of the whole, by what they cost (bench_export, bench_printing).
  Pace stage(std::string_view name) const;
  Result<void> extract();
  void keep_ambiguous(const Pace& pace);
  Result<void> make_mesh();
  void certify();
  Result<void> write_and_check(const std::filesystem::path& temporary, MeshFormat format);
  Result<void> write_once(const std::filesystem::path& temporary, MeshFormat format);

  const std::filesystem::path& file_;
  const Clay& clay_;
  const ExportOptions& options_;
  Pace pace_;
  TriangleMesh surface_;  ///< without small components; empty where nothing is removed from it
  mesh::SmallComponents left_out_;             ///< those
  TriangleMesh mesh_;                          ///< what is written
  std::optional<ExtractedSurface> extracted_;  ///< what it is measured by
  double extracted_volume_ = 0.0;
  ExportReport report_;
};

Pace Export::stage(std::string_view name) const {
  const bool fewer = removes_triangles();
  if (name == "surface") return pace_.part(name, 0.0, 0.05);
  if (name == "decimate") return pace_.part(name, 0.05, 0.6);
  if (name == "measure") return pace_.part(name, fewer ? 0.6 : 0.05, fewer ? 0.95 : 0.45);
  if (name == "write") return pace_.part(name, fewer ? 0.95 : 0.45, fewer ? 0.97 : 0.55);
  return pace_.part(name, fewer ? 0.97 : 0.55, 1.0);
}

Result<void> Export::extract() {
  const Pace pace = stage("surface");
  auto surface = extract_surface(clay_, [&](std::string_view of, double fraction) {
    pace.at(of == "weld" ? 0.6 + 0.4 * fraction : 0.6 * fraction);
    return true;
  });
  if (!surface) return surface.error();
  surface_ = std::move(surface).value();
  report_.certificate.surface_triangles = static_cast<std::int64_t>(surface_.triangles.size());
  extracted_volume_ = signed_volume(surface_);
  surface_.normals = {};
  left_out_ = mesh::drop_small_components(surface_, clay_.options().voxel_mm);
  if (surface_.triangles.empty()) {
    return Error{ErrorKind::bad_input,
                 "there is no clay to export to '" + file_.string() + "'; add some first"};
  }
  return {};
}

/// Where the field does not tell a component that was left out from what is beside it nothing could
/// be proven: it stays. What was told from all but these may then not be told from them: what is
/// near is looked at again until nothing changes, and all of the surface at last.
void Export::keep_ambiguous(const Pace& pace) {
  const auto put_back_from = [this](ExtractedSurface& extracted, const Pace& part) {
    extracted.prepare(part);
    const std::span<const std::uint32_t> ambiguous = extracted.ambiguous();
    if (!ambiguous.empty()) mesh::put_back(surface_, left_out_, ambiguous);
    return !ambiguous.empty();
  };
  const auto put_back_near = [&] {
    const Pace unknown = pace.part(0.0, 0.0);
    const TriangleMesh near = surface_near(surface_, left_out_.mesh, clay_, unknown);
    ExtractedSurface around(near, clay_, left_out_.mesh);
    return put_back_from(around, unknown);
  };
  for (;;) {
    while (left_out_.count > 0 && put_back_near()) {
    }
    extracted_.emplace(surface_, clay_, left_out_.mesh);
    if (left_out_.count == 0 || !put_back_from(*extracted_, pace)) return;
  }
}

Result<void> Export::make_mesh() {
  const auto whole = static_cast<std::int64_t>(surface_.triangles.size());
  const bool has_count = options_.triangles != 0 && options_.triangles < whole;
  // Nothing to remove: the surface itself is written.
  if (options_.max_error_mm == 0.0 && !has_count) {
    mesh_ = mesh::rounded_to_float(std::exchange(surface_, {}));
    return {};
  }
  mesh::DecimateOptions fewer;
  fewer.triangles = has_count ? options_.triangles : 0;
  fewer.max_error_mm = options_.max_error_mm;
  extracted_.emplace(surface_, clay_, left_out_.mesh);
  const Pace pace = stage("decimate");
  if (options_.max_error_mm > 0.0) keep_ambiguous(pace.part(0.0, 0.1));
  auto decimated = decimate_extracted(*extracted_, fewer, pace.part(0.1, 1.0).progress());
  if (!decimated) return decimated.error();
  mesh_ = std::move(decimated.value().mesh);
  return {};
}

/// Measures what the file will hold.
void Export::certify() {
  assert(!mesh_.triangles.empty());
  // Where nothing was removed the mesh is its own surface, and changes where folds are collapsed.
  const bool is_its_own = surface_.triangles.empty();
  if (is_its_own) extracted_.emplace(mesh_, clay_, left_out_.mesh);
  mesh::Certificate& certificate = report_.certificate;
  certificate.error = field_error(mesh_, *extracted_, stage("measure"));
  // The file is read back beside what is kept here.
  if (is_its_own) extracted_.reset();
  certificate.volume_change = (signed_volume(mesh_) - extracted_volume_) / extracted_volume_;
  certificate.triangles = static_cast<std::int64_t>(mesh_.triangles.size());
  certificate.voxel_mm = clay_.options().voxel_mm;
  certificate.tolerance_voxels = clay_.options().tolerance_voxels;
  // What was collapsed after the proof is not in it.
  certificate.proven_max_mm = report_.collapsed_edges == 0 ? options_.max_error_mm : 0.0;
  certificate.asked_max_error_mm = options_.max_error_mm;
  certificate.asked_triangles = options_.triangles;
  certificate.clay_hash = clay_.hash();
}

/// Writes the mesh and judges what a reader of the file will see.
Result<void> Export::write_once(const std::filesystem::path& temporary, MeshFormat format) {
  // In every round, since collapsing a fold changes what is certified.
  certify();
  WriteOptions options;
  options.title = file_.stem().string();
  options.metadata = mesh::metadata_of(report_.certificate);
  if (options_.parts) {
    mesh::MeshBodies bodies = mesh::mesh_bodies(mesh_);
    assert(bodies.of_triangle.size() == mesh_.triangles.size());
    options.parts = std::move(bodies.of_triangle);
    report_.parts = bodies.count;
  }
  stage("write").at(0.0);
  OutputFile out(temporary);
  const Result<void> written = write_format(out, format, mesh_, options, stage("write").progress());
  const Result<void> closed = out.close();
  if (!written) return written;
  if (!closed) return closed;
  // From the disk, so that a fault of the writer shows as well.
  stage("check").at(0.0);
  Result<TriangleMesh> back = read_mesh(temporary);
  if (!back) return back.error();
  // Text holds the shortest decimals that give the float back; as doubles they differ from it.
  const TriangleMesh read = mesh::rounded_to_float(std::move(back).value());
  report_.verdict =
      mesh::judge_mesh(read, {}, 0, mesh::wall_thickness, stage("check").part(0.1, 1.0));
  return {};
}

Result<void> Export::write_and_check(const std::filesystem::path& temporary, MeshFormat format) {
  constexpr int kMostRounds = 4;
  for (int round = 0;; ++round) {
    if (Result<void> written = write_once(temporary, format); !written) return written;
    const bool folded = report_.verdict.degenerate + report_.verdict.self_intersections > 0;
    if (!folded || round == kMostRounds) return {};
    // Rounding to float may fold slivers; the next round writes the mesh without them.
    const std::int64_t collapsed = mesh::collapse_folded(mesh_);
    if (collapsed == 0) return {};
    report_.collapsed_edges += collapsed;
  }
}

Result<ExportReport> Export::run() {
  const Result<MeshFormat> format = mesh_format_of(file_);
  if (!format) return format.error();
  if (options_.parts && format.value() != MeshFormat::threemf) {
    return Error{ErrorKind::bad_input,
                 file_.string() +
                     ": the format has no place for parts; export a .3mf, or leave "
                     "the parts out"};
  }
  if (Result<void> extracted = extract(); !extracted) return extracted.error();
  if (Result<void> made = make_mesh(); !made) return made.error();
  report_.removed_components = left_out_.count;
  // Parts have shorter numbers: what they take the writer foretells.
  const Result<void> fits = options_.parts ? Result<void>{}
                                           : check_size(format.value(), mesh_,
                                                        stage("measure").part(0.0, 0.0).progress());
  if (!fits) return fits.error();
  const Result<void> written =
      replace_file(file_, [&](const std::filesystem::path& temporary) -> Result<void> {
        return write_and_check(temporary, format.value());
      });
  if (!written) return written.error();
  const mesh::Certificate& certificate = report_.certificate;
  report_.triangles = certificate.triangles;
  report_.max_error_mm = certificate.error.max_mm();
  report_.rms_error_mm = certificate.error.rms_mm();
  report_.volume_change = certificate.volume_change;
  return std::move(report_);
}

}  // namespace

Result<ExportReport> export_mesh(const std::filesystem::path& file, const Clay& clay,
                                 const ExportOptions& options, const Progress& progress) {
  return no_throw(file.string(), [&] { return Export(file, clay, options, progress).run(); });
}

}  // namespace argil::io
