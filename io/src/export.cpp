// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/export.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "argil/engine/surface.h"
#include "argil/io/decimate.h"
#include "argil/io/mesh_file.h"
#include "argil/io/safe_file.h"

#include "file_bytes.h"
#include "mesh_bodies.h"
#include "mesh_crumbs.h"
#include "mesh_mend.h"
#include "mesh_write.h"
#include "no_throw.h"

namespace argil::io {
namespace {

class Export {
 public:
  Export(const std::filesystem::path& file, const Clay& clay, const ExportOptions& options,
         const Progress& progress)
      : file_(file), clay_(clay), options_(options), progress_(progress) {}

  Result<ExportReport> run();

 private:
  Result<void> go_on(std::string_view stage, double fraction) const {
    if (!progress_ || progress_(stage, fraction)) return {};
    return Error{ErrorKind::interrupted,
                 "interrupted while exporting '" + file_.string() + "'; it is as it was before"};
  }
  Result<void> extract();
  Result<void> make_mesh();
  Result<void> certify();
  Result<void> write_and_check(const std::filesystem::path& temporary, MeshFormat format);
  Result<void> write_once(const std::filesystem::path& temporary, MeshFormat format);

  const std::filesystem::path& file_;
  const Clay& clay_;
  const ExportOptions& options_;
  const Progress& progress_;
  TriangleMesh surface_;
  TriangleMesh mesh_;  ///< what is written
  double extracted_volume_ = 0.0;
  ExportReport report_;
};

Result<void> Export::extract() {
  if (Result<void> on = go_on("surface", 0.0); !on) return on;
  surface_ = extract_surface(clay_);
  report_.certificate.surface_triangles = static_cast<std::int64_t>(surface_.triangles.size());
  extracted_volume_ = signed_volume(surface_);
  report_.removed_crumbs = drop_crumbs(surface_, clay_.options().voxel_mm);
  if (surface_.triangles.empty()) {
    return Error{ErrorKind::bad_input,
                 "there is no clay to export to '" + file_.string() + "'; add some first"};
  }
  surface_.normals.clear();
  return go_on("surface", 1.0);
}

Result<void> Export::make_mesh() {
  const bool has_bound = options_.max_error_mm != 0.0;
  const auto whole = static_cast<std::int64_t>(surface_.triangles.size());
  const bool has_count = options_.triangles != 0 && options_.triangles < whole;
  if (!has_bound && !has_count) {
    mesh_ = rounded_to_float(surface_);
    return {};
  }
  DecimateOptions fewer;
  fewer.triangles = has_count ? options_.triangles : 0;
  fewer.max_error_mm = options_.max_error_mm;
  auto decimated = decimate(surface_, clay_, fewer, progress_);
  if (!decimated) return decimated.error();
  mesh_ = std::move(decimated.value().mesh);
  return {};
}

/// Measures what the file will hold.
Result<void> Export::certify() {
  if (Result<void> on = go_on("measure", 0.0); !on) return on;
  const Result<MeshError> error = measure_error(mesh_, surface_, clay_);
  if (!error) return error.error();
  Certificate& certificate = report_.certificate;
  certificate.error = error.value();
  certificate.volume_change = (signed_volume(mesh_) - extracted_volume_) / extracted_volume_;
  certificate.triangles = static_cast<std::int64_t>(mesh_.triangles.size());
  certificate.voxel_mm = clay_.options().voxel_mm;
  certificate.tolerance_voxels = clay_.options().tolerance_voxels;
  certificate.asked_max_error_mm = options_.max_error_mm;
  certificate.asked_triangles = options_.triangles;
  certificate.clay_hash = clay_.hash();
  return go_on("measure", 1.0);
}

/// Writes the mesh and judges what a reader of the file will see.
Result<void> Export::write_once(const std::filesystem::path& temporary, MeshFormat format) {
  if (Result<void> measured = certify(); !measured) return measured;
  WriteOptions options;
  options.title = file_.stem().string();
  options.metadata = metadata_of(report_.certificate);
  if (options_.parts) {
    MeshBodies bodies = mesh_bodies(mesh_);
    options.parts = std::move(bodies.of_triangle);
    report_.parts = bodies.count;
  }
  OutputFile out(temporary);
  const Result<void> written = write_format(out, format, mesh_, options, progress_);
  const Result<void> closed = out.close();
  if (!written) return written;
  if (!closed) return closed;
  if (Result<void> on = go_on("check", 0.0); !on) return on;
  Result<TriangleMesh> back = read_mesh(temporary);
  if (!back) return back.error();
  // Text holds the shortest decimals that give the float back; as doubles they differ from it.
  report_.verdict = check_mesh(rounded_to_float(std::move(back).value()));
  return go_on("check", 1.0);
}

Result<void> Export::write_and_check(const std::filesystem::path& temporary, MeshFormat format) {
  constexpr int kMostRounds = 4;
  for (int round = 0;; ++round) {
    if (Result<void> written = write_once(temporary, format); !written) return written;
    const bool folded = report_.verdict.degenerate + report_.verdict.self_intersections > 0;
    if (!folded || round == kMostRounds) return {};
    const std::int64_t collapsed = collapse_folded(mesh_);
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
  const Result<void> written =
      replace_file(file_, [&](const std::filesystem::path& temporary) -> Result<void> {
        return write_and_check(temporary, format.value());
      });
  if (!written) return written.error();
  const Certificate& certificate = report_.certificate;
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
