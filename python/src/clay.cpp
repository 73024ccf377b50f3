// SPDX-License-Identifier: GPL-3.0-or-later
// The clay: made, sculpted, changed as a whole, kept, exported.
#include "clay.h"

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "argil/core/hash_text.h"
#include "argil/engine/clay_copy.h"
#include "argil/engine/import.h"
#include "argil/engine/operation.h"
#include "argil/engine/surface.h"
#include "argil/io/clay_check.h"
#include "argil/io/decimate.h"
#include "argil/io/export.h"
#include "argil/io/session.h"
#include "argil/io/stroke_script.h"
#include "argil/io/volume_file.h"
#include "argil/mesh/close.h"

#include "arrays.h"
#include "choice.h"
#include "common/output.h"
#include "common/reports.h"
#include "convert.h"
#include "mesh.h"

namespace argil::python {

Result<void> SharedClay::update_picker(const Clay& clay) {
  auto updated = surface_.update(clay);
  if (!updated) return updated.error();
  return picker_.update(surface_);
}

namespace {

using ClayHolder = std::shared_ptr<SharedClay>;

ClayHolder hold(Clay clay) { return std::make_shared<SharedClay>(std::move(clay)); }

ClayOptions options_of(double voxel_mm, double tolerance_voxels,
                       std::optional<double> edge_radius_mm) {
  return {voxel_mm, tolerance_voxels, edge_radius_mm};
}

ClayHolder ball(double radius_mm, double voxel_mm, double tolerance_voxels,
                std::optional<double> edge_radius_mm) {
  const ClayOptions options = options_of(voxel_mm, tolerance_voxels, edge_radius_mm);
  return hold(run_apart([=] { return Clay::ball(radius_mm, options); }));
}

ClayHolder block(py::handle size_mm, double voxel_mm, double tolerance_voxels,
                 std::optional<double> edge_radius_mm) {
  const ClayOptions options = options_of(voxel_mm, tolerance_voxels, edge_radius_mm);
  const Vec3 size = vec3_of("size_mm", size_mm);
  return hold(run_apart([=] { return Clay::block(size, options); }));
}

/// Throws where a vertex lies farther out than a clay can reach, which what closes and imports
/// meshes relies on.
void check_reach(const TriangleMesh& mesh) {
  for (std::size_t n = 0; n < mesh.positions.size(); ++n) {
    if (is_in_reach(mesh.positions[n])) continue;
    raise_bad_input("vertex " + std::to_string(n) + " of the mesh lies more than " +
                    std::to_string(static_cast<std::int64_t>(kMaxReachMm)) +
                    " mm from the origin; scale it, or give its unit");
  }
}

/// A mesh without holes: closed as `argil import` closes what it reads.
Result<TriangleMesh> closed_mesh(const TriangleMesh& mesh, const Progress& progress) {
  auto closed = mesh::close_mesh(mesh, progress);
  if (!closed) return closed.error();
  return std::move(closed.value().mesh);
}

ClayHolder from_mesh(const SharedMesh& mesh, double voxel_mm, double tolerance_voxels,
                     std::optional<double> edge_radius_mm, bool repairs) {
  const ClayOptions options = options_of(voxel_mm, tolerance_voxels, edge_radius_mm);
  check_reach(mesh.mesh());
  return hold(run([&](const Progress& progress) -> Result<Clay> {
    std::optional<TriangleMesh> closed;
    if (repairs) {
      auto made = closed_mesh(mesh.mesh(), progress);
      if (!made) return made.error();
      closed = std::move(made).value();
    }
    auto imported = import_mesh(closed ? *closed : mesh.mesh(), options, progress);
    if (!imported) return imported.error();
    return std::move(imported.value().clay);
  }));
}

/// The clay of a project and what of its recovery a person should know.
py::tuple load(const std::filesystem::path& file, const std::string& piece) {
  std::vector<std::string> notes;
  Clay clay = run([&](const Progress& progress) -> Result<Clay> {
    auto opened = io::open_project(file, progress);
    if (!opened) return opened.error();
    notes = std::move(opened.value().notes);
    Sculpture& sculpture = opened.value().sculpture;
    if (piece.empty() && sculpture.piece_count() > 1) {
      std::string names;
      for (std::size_t n = 0; n < sculpture.piece_count(); ++n) {
        names.append(n == 0 ? "'" : ", '").append(sculpture.look(n).name).append("'");
      }
      return Error{ErrorKind::bad_input, "'" + file.string() + "' has several pieces, " + names +
                                             "; name the one that is meant by piece="};
    }
    if (!piece.empty()) {
      if (auto chosen = sculpture.apply(SelectPiece{piece}); !chosen) return chosen.error();
    }
    return std::move(sculpture).take_clay();
  });
  return py::make_tuple(hold(std::move(clay)), notes);
}

std::vector<std::string> save(SharedClay& self, const std::filesystem::path& file) {
  return self.run(
      [&](const Clay& clay, const Progress&) { return io::replace_project(file, clay); });
}

py::object info(SharedClay& self) {
  const cli::Json json =
      self.run([](const Clay& clay, const Progress& progress) -> Result<cli::Json> {
        const auto surface = extract_surface(clay, progress);
        if (!surface) return surface.error();
        return cli::clay_json(clay, surface.value());
      });
  return from_json(json);
}

/// Rows of a stroke: x, y, z; or seconds before them; or orientation and pressure behind them too.
std::vector<StrokeSample> samples_of(const Rows& poses) {
  const bool fits = poses.ndim() == 2 && poses.shape(0) > 0 &&
                    (poses.shape(1) == 3 || poses.shape(1) == 4 || poses.shape(1) == 9);
  if (!fits) {
    raise_bad_input("poses has the shape " + shape_text(poses) +
                    "; give at least one row of x, y, z; of t, x, y, z; or of t, x, y, z, qw, qx, "
                    "qy, qz, pressure");
  }
  const py::ssize_t columns = poses.shape(1);
  std::vector<StrokeSample> samples(static_cast<std::size_t>(poses.shape(0)));
  const double* row = poses.data();
  for (StrokeSample& sample : samples) {
    const double* place = columns == 3 ? row : row + 1;
    if (columns > 3) sample.time_s = row[0];
    sample.position_mm = {place[0], place[1], place[2]};
    if (columns == 9) {
      sample.orientation = {row[4], row[5], row[6], row[7]};
      sample.pressure = row[8];
    }
    row += columns;
  }
  return samples;
}

py::dict stroke_report(const StrokeReport& report) {
  constexpr const char* kSymmetries[] = {"none", "exact", "unlike", "withheld"};
  py::dict dict;
  dict["dabs"] = report.dabs;
  dict["level"] = report.level;
  dict["symmetry"] = kSymmetries[static_cast<std::size_t>(report.symmetry)];
  return dict;
}

/// `line`: a step of a script (docs/files.md), of a stroke with one pose, which `poses` replace.
py::dict apply_line(SharedClay& self, const std::string& line, const std::optional<Rows>& poses,
                    const std::filesystem::path& folder) {
  io::ScriptStep step = value_of(io::read_script_step("step", line, folder));
  if (poses) {
    auto* stroke = std::get_if<Stroke>(&step);
    if (stroke == nullptr) raise_bad_input("poses belong to strokes; leave them out");
    stroke->samples = samples_of(*poses);
  }
  return stroke_report(self.run(
      [&](Clay& clay, const Progress& progress) { return io::apply_step(clay, step, progress); }));
}

/// All steps of a script, one after the other; those before a step that fails stay.
py::dict apply_script(SharedClay& self, const std::filesystem::path& file) {
  struct Done {
    std::int64_t steps = 0;
    std::int64_t dabs = 0;
  };
  const io::StrokeScript script = run_apart([file] { return io::read_stroke_script(file); });
  const Done done = self.run([&](Clay& clay, const Progress& progress) -> Result<Done> {
    Done so_far;
    for (const io::ScriptStep& step : script.steps) {
      auto report = io::apply_step(clay, step, progress);
      if (!report) {
        return Error{report.error().kind, file.string() + ": step " +
                                              std::to_string(so_far.steps + 1) + ": " +
                                              report.error().message};
      }
      ++so_far.steps;
      so_far.dabs += report.value().dabs;
    }
    return so_far;
  });
  py::dict dict;
  dict["steps"] = done.steps;
  dict["dabs"] = done.dabs;
  return dict;
}

/// The clay that a script starts from.
ClayHolder start_of_script(const std::filesystem::path& file) {
  const io::StrokeScript script = run_apart([file] { return io::read_stroke_script(file); });
  if (!script.start) {
    raise_bad_input("'" + file.string() +
                    "' has no 'start'; add it to the script's first line, or apply the script to a "
                    "clay that you have");
  }
  return hold(run_apart([start = *script.start] {
    return start.kind == io::StartShape::Kind::ball ? Clay::ball(start.size_mm.x, start.options)
                                                    : Clay::block(start.size_mm, start.options);
  }));
}

/// `other` as it is now: combining a clay with itself works, and nothing waits for two clays.
void combine(SharedClay& self, const std::string& kind,
             const std::variant<ClayHolder, std::shared_ptr<SharedMesh>>& other,
             py::handle position_mm, const std::array<double, 4>& q, bool repairs) {
  Combine with;
  with.kind = choice_of<CombineKind>("kind", kind,
                                     {{"union", CombineKind::unite},
                                      {"difference", CombineKind::subtract},
                                      {"intersection", CombineKind::intersect}});
  with.placement = {vec3_of("position_mm", position_mm), {q[0], q[1], q[2], q[3]}};
  if (const auto* clay = std::get_if<ClayHolder>(&other)) {
    with.clay = std::make_shared<const Clay>((*clay)->run(
        [](const Clay& source, const Progress&) -> Result<Clay> { return copy_of(source); }));
  } else {
    const SharedMesh& mesh = *std::get<std::shared_ptr<SharedMesh>>(other);
    check_reach(mesh.mesh());
    with.mesh = std::make_shared<const TriangleMesh>(run([&](const Progress& progress) {
      return repairs ? closed_mesh(mesh.mesh(), progress) : Result<TriangleMesh>(mesh.mesh());
    }));
  }
  self.run([&](Clay& clay, const Progress& progress) {
    return clay.apply(Operation(std::move(with)), progress);
  });
}

std::shared_ptr<SharedMesh> surface(SharedClay& self) {
  return std::make_shared<SharedMesh>(self.run(
      [](const Clay& clay, const Progress& progress) { return extract_surface(clay, progress); }));
}

/// Fewer triangles, small components left out as in an export.
std::shared_ptr<SharedMesh> decimate(SharedClay& self, std::int64_t triangles,
                                     double max_error_mm) {
  return std::make_shared<SharedMesh>(
      self.run([&](const Clay& clay, const Progress& progress) -> Result<TriangleMesh> {
        auto whole = extract_surface(clay, progress);
        if (!whole) return whole.error();
        mesh::DecimateOptions options;
        options.triangles = triangles;
        options.max_error_mm = max_error_mm;
        auto fewer = io::decimate(whole.value(), clay, options, {}, progress);
        if (!fewer) return fewer.error();
        return std::move(fewer.value().mesh);
      }));
}

py::object export_as_mesh(SharedClay& self, const std::filesystem::path& file,
                          std::int64_t triangles, double max_error_mm, bool parts) {
  const cli::Stopwatch watch;
  io::ExportOptions options;
  options.triangles = triangles;
  options.max_error_mm = max_error_mm;
  options.parts = parts;
  const io::ExportReport report = self.run([&](const Clay& clay, const Progress& progress) {
    return io::export_mesh(file, clay, options, progress);
  });
  return from_json(cli::export_json(report, watch.seconds()));
}

py::dict export_as_volume(SharedClay& self, const std::filesystem::path& file) {
  const io::VolumeReport report = self.run([&](const Clay& clay, const Progress& progress) {
    return io::export_volume(file, clay, progress);
  });
  py::dict dict;
  dict["voxel_mm"] = report.voxel_mm;
  dict["active_voxels"] = report.active_voxels;
  dict["leaves"] = report.leaves;
  dict["bytes"] = report.bytes;
  return dict;
}

py::object judge_clay(SharedClay& self, const std::string& printer_file, double min_wall_mm,
                      double min_gap_mm, double overhang_deg) {
  const mesh::Printer printer = printer_of(printer_file, min_wall_mm, min_gap_mm, overhang_deg);
  const io::ClayVerdict judged = self.run([&](const Clay& clay, const Progress& progress) {
    return io::check_clay(clay, printer, progress);
  });
  cli::Json json = cli::to_json(judged.verdict);
  json["triangles"] = judged.mesh.triangles.size();
  json["removed_crumbs"] = judged.removed_components;
  return from_json(json);
}

ClayHolder copy(SharedClay& self) {
  return hold(
      self.run([](const Clay& clay, const Progress&) -> Result<Clay> { return copy_of(clay); }));
}

bool step_back(SharedClay& self, bool is_redo) {
  return self.run([&](Clay& clay, const Progress&) -> Result<bool> {
    return is_redo ? clay.redo() : clay.undo();
  });
}

void add_makers(py::class_<SharedClay, ClayHolder>& clay) {
  const ClayOptions usual;
  const auto voxel = py::arg("voxel_mm") = usual.voxel_mm;
  const auto tolerance = py::arg("tolerance_voxels") = usual.tolerance_voxels;
  const auto edge = py::arg("edge_radius_mm") = py::none();
  clay.def_static("ball", &ball, py::arg("radius_mm"), voxel, tolerance, edge)
      .def_static("block", &block, py::arg("size_mm"), voxel, tolerance, edge)
      .def_static("from_mesh", &from_mesh, py::arg("mesh"), py::arg("voxel_mm"), tolerance, edge,
                  py::arg("repair") = true)
      .def_static("load", &load, py::arg("file"), py::arg("piece"))
      .def_static("start_of_script", &start_of_script, py::arg("file"));
}

void add_edits(py::class_<SharedClay, ClayHolder>& clay) {
  clay.def("apply_line", &apply_line, py::arg("line"), py::arg("poses"), py::arg("folder"))
      .def("apply_script", &apply_script, py::arg("file"))
      .def("combine", &combine, py::arg("kind"), py::arg("other"), py::arg("position_mm"),
           py::arg("orientation"), py::arg("repair"))
      .def("undo", [](SharedClay& self) { return step_back(self, false); })
      .def("redo", [](SharedClay& self) { return step_back(self, true); })
      .def("undo_depth", [](SharedClay& self) {
        return self.look([](const Clay& c) { return c.undo_depth(); });
      });
}

void add_results(py::class_<SharedClay, ClayHolder>& clay) {
  clay.def("save", &save, py::arg("file"))
      .def("info", &info)
      .def("copy", &copy)
      .def("hash",
           [](SharedClay& self) {
             return hash_text(self.run(
                 [](const Clay& c, const Progress&) -> Result<std::uint64_t> { return c.hash(); }));
           })
      .def("options",
           [](SharedClay& self) {
             const ClayOptions options = self.look([](const Clay& c) { return c.options(); });
             return py::make_tuple(options.voxel_mm, options.tolerance_voxels,
                                   options.edge_radius_mm);
           })
      .def("levels",
           [](SharedClay& self) {
             return from_json(
                 cli::to_json(self.look([](const Clay& c) { return c.level_stats(); })));
           })
      .def("bounds_mm",
           [](SharedClay& self) {
             const Box3 box = self.look([](const Clay& c) { return c.bounds_mm(); });
             return py::make_tuple(tuple_of(box.min), tuple_of(box.max));
           })
      .def("surface", &surface)
      .def("decimate", &decimate, py::arg("triangles"), py::arg("max_error_mm"))
      .def("export_as_mesh", &export_as_mesh, py::arg("file"), py::arg("triangles"),
           py::arg("max_error_mm"), py::arg("parts"))
      .def("export_as_volume", &export_as_volume, py::arg("file"))
      .def("check", &judge_clay, py::arg("printer"), py::arg("min_wall_mm"), py::arg("min_gap_mm"),
           py::arg("overhang_deg"));
}

}  // namespace

void add_clay(py::module_& module) {
  py::class_<SharedClay, ClayHolder> clay(module, "Clay");
  add_makers(clay);
  add_edits(clay);
  add_results(clay);
  add_queries(clay);
}

}  // namespace argil::python
