// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/io/export.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "argil/engine/surface.h"
#include "argil/io/mesh_file.h"
#include "argil/io/safe_file.h"

#include "file_bytes.h"
#include "mesh_edges.h"
#include "mesh_mend.h"
#include "mesh_write.h"
#include "no_throw.h"

namespace argil::io {
namespace {

/// Leaves out closed parts that enclose less than one voxel: specks that no print can show, and
/// that a slicer would count as parts. How many were left out.
std::int64_t drop_crumbs(TriangleMesh& mesh, double voxel_mm) {
  const EdgeTable edges(mesh);
  const MeshParts parts = mesh_parts(mesh, edges, false);
  const std::vector<double> volumes = part_volumes(mesh, parts);
  const double least = voxel_mm * voxel_mm * voxel_mm;
  const auto is_crumb = [&](double volume) { return std::abs(volume) < least; };
  const std::int64_t crumbs = std::count_if(volumes.begin(), volumes.end(), is_crumb);
  if (crumbs == 0) return 0;
  TriangleMesh kept;
  std::vector<std::uint32_t> number(mesh.positions.size(), kNoPart);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (is_crumb(volumes[parts.of_triangle[i]])) continue;
    Triangle t = mesh.triangles[i];
    for (std::uint32_t& v : t) {
      if (number[v] == kNoPart) {
        number[v] = static_cast<std::uint32_t>(kept.positions.size());
        kept.positions.push_back(mesh.positions[v]);
      }
      v = number[v];
    }
    kept.triangles.push_back(t);
  }
  mesh = std::move(kept);
  return crumbs;
}

struct ErrorSum {
  double max = 0.0;
  double squares = 0.0;
  std::int64_t count = 0;

  void add(double distance) noexcept {
    max = std::max(max, std::abs(distance));
    squares += distance * distance;
    ++count;
  }
};

/// Distance of vertices, edge middles and centroids from the clay's surface. Blocks of fixed size,
/// joined in their order, so that the sum does not depend on how threads shared them.
ErrorSum measure_error(const TriangleMesh& mesh, const Clay& clay) {
  constexpr std::size_t kBlock = 4096;
  const auto at = [&](std::uint32_t v) { return mesh.positions[v]; };
  const auto measure_vertex = [&](std::size_t i, ErrorSum& sum) {
    sum.add(clay.distance_at(mesh.positions[i]));
  };
  const auto measure_triangle = [&](std::size_t i, ErrorSum& sum) {
    const auto& [a, b, c] = mesh.triangles[i];
    sum.add(clay.distance_at((at(a) + at(b) + at(c)) / 3.0));
    // Every edge of a closed mesh is run along once in each direction.
    if (a < b) sum.add(clay.distance_at((at(a) + at(b)) / 2.0));
    if (b < c) sum.add(clay.distance_at((at(b) + at(c)) / 2.0));
    if (c < a) sum.add(clay.distance_at((at(c) + at(a)) / 2.0));
  };
  ErrorSum total;
  const auto each = [&](std::size_t count, const auto& measure) {
    std::vector<ErrorSum> blocks((count + kBlock - 1) / kBlock);
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t block) {
      const std::size_t end = std::min(count, (block + 1) * kBlock);
      for (std::size_t i = block * kBlock; i < end; ++i) measure(i, blocks[block]);
    });
    for (const ErrorSum& sum : blocks) {
      total.max = std::max(total.max, sum.max);
      total.squares += sum.squares;
      total.count += sum.count;
    }
  };
  each(mesh.positions.size(), measure_vertex);
  each(mesh.triangles.size(), measure_triangle);
  return total;
}

class Export {
 public:
  Export(const std::filesystem::path& file, const Clay& clay, const Progress& progress)
      : file_(file), clay_(clay), progress_(progress) {}

  Result<ExportReport> run();

 private:
  Result<void> go_on(std::string_view stage, double fraction) const {
    if (!progress_ || progress_(stage, fraction)) return {};
    return Error{ErrorKind::interrupted,
                 "interrupted while exporting '" + file_.string() + "'; it is as it was before"};
  }
  Result<void> extract();
  Result<void> write_and_check(const std::filesystem::path& temporary, MeshFormat format);
  Result<void> write_once(const std::filesystem::path& temporary, MeshFormat format);

  const std::filesystem::path& file_;
  const Clay& clay_;
  const Progress& progress_;
  TriangleMesh mesh_;
  double extracted_volume_ = 0.0;
  ExportReport report_;
};

Result<void> Export::extract() {
  if (Result<void> on = go_on("surface", 0.0); !on) return on;
  mesh_ = extract_surface(clay_);
  extracted_volume_ = signed_volume(mesh_);
  report_.removed_crumbs = drop_crumbs(mesh_, clay_.options().voxel_mm);
  if (mesh_.triangles.empty()) {
    return Error{ErrorKind::bad_input,
                 "there is no clay to export to '" + file_.string() + "'; add some first"};
  }
  mesh_.normals.clear();
  mesh_ = rounded_to_float(std::move(mesh_));
  return go_on("surface", 1.0);
}

/// Writes the mesh and judges what a reader of the file will see.
Result<void> Export::write_once(const std::filesystem::path& temporary, MeshFormat format) {
  WriteOptions options;
  options.title = file_.stem().string();
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
  if (Result<void> extracted = extract(); !extracted) return extracted.error();
  const Result<void> written =
      replace_file(file_, [&](const std::filesystem::path& temporary) -> Result<void> {
        return write_and_check(temporary, format.value());
      });
  if (!written) return written.error();
  const ErrorSum error = measure_error(mesh_, clay_);
  report_.triangles = static_cast<std::int64_t>(mesh_.triangles.size());
  report_.max_error_mm = error.max;
  report_.rms_error_mm = std::sqrt(error.squares / static_cast<double>(error.count));
  report_.volume_change = (signed_volume(mesh_) - extracted_volume_) / extracted_volume_;
  return std::move(report_);
}

}  // namespace

Result<ExportReport> export_mesh(const std::filesystem::path& file, const Clay& clay,
                                 const Progress& progress) {
  return no_throw(file.string(), [&] { return Export(file, clay, progress).run(); });
}

}  // namespace argil::io
