// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes: from and to arrays and files, judged, repaired.
#include "mesh.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "argil/io/mesh_file.h"
#include "argil/io/mesh_frame.h"
#include "argil/io/mesh_repair.h"
#include "argil/io/printer_file.h"
#include "argil/mesh/check.h"

#include "arrays.h"
#include "choice.h"
#include "common/output.h"
#include "common/reports.h"
#include "convert.h"
#include "work.h"

namespace argil::python {
namespace {

using Indices = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;

std::vector<Triangle> triangles_of(const Indices& faces, std::size_t vertices) {
  if (faces.ndim() != 2 || faces.shape(1) != 3) {
    raise_bad_input("faces has the shape " + shape_text(faces) + "; give one of (n, 3), triangles");
  }
  std::vector<Triangle> triangles(static_cast<std::size_t>(faces.shape(0)));
  const std::int64_t* index = faces.data();
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t corner = 0; corner < 3; ++corner, ++index) {
      if (*index < 0 || *index >= static_cast<std::int64_t>(vertices)) {
        raise_bad_input("faces[" + std::to_string(t) + "] names the vertex " +
                        std::to_string(*index) + ", and there are " + std::to_string(vertices) +
                        "; count them from 0");
      }
      triangles[t][corner] = static_cast<std::uint32_t>(*index);
    }
  }
  return triangles;
}

/// `normals`: none, or one for each vertex, of unit length.
std::shared_ptr<SharedMesh> mesh_of_arrays(const Rows& vertices, const Indices& faces,
                                           const std::optional<Rows>& normals) {
  const auto positions = points_of("vertices", vertices);
  check_finite("vertices", positions);
  TriangleMesh mesh;
  mesh.triangles = triangles_of(faces, positions.size());
  mesh.positions.assign(positions.begin(), positions.end());
  if (normals && normals->size() > 0) {
    const auto given = points_of("normals", *normals);
    check_finite("normals", given);
    if (given.size() != positions.size()) {
      raise_bad_input("there are " + std::to_string(given.size()) + " normals and " +
                      std::to_string(positions.size()) + " vertices; give one for each");
    }
    mesh.normals.assign(given.begin(), given.end());
  }
  return std::make_shared<SharedMesh>(std::move(mesh));
}

io::MeshFrame frame_of(const std::optional<std::string>& unit,
                       const std::optional<std::string>& up) {
  io::MeshFrame frame;
  Words<io::LengthUnit> units;
  for (const io::LengthUnit one :
       {io::LengthUnit::mm, io::LengthUnit::cm, io::LengthUnit::m, io::LengthUnit::in}) {
    units.emplace_back(io::unit_name(one), one);
  }
  if (unit) frame.unit = choice_of<io::LengthUnit>("unit", *unit, units);
  if (up) {
    frame.up = choice_of<io::UpAxis>("up", *up, {{"y", io::UpAxis::y}, {"z", io::UpAxis::z}});
  }
  return frame;
}

/// The mesh, and what of it should be doubted, a sentence each.
py::tuple read(const std::filesystem::path& file, const std::optional<std::string>& unit,
               const std::optional<std::string>& up) {
  const io::MeshFrame frame = frame_of(unit, up);
  io::FramedMesh read = run_apart([=] { return io::read_framed_mesh(file, frame); });
  const auto doubts = io::frame_doubts(file, read.frame);
  return py::make_tuple(std::make_shared<SharedMesh>(std::move(read.mesh)), doubts);
}

void write(const SharedMesh& mesh, const std::filesystem::path& file, const std::string& title) {
  io::WriteOptions options;
  options.title = title;
  run([&](const Progress& progress) {
    return io::write_mesh(file, mesh.mesh(), options, progress);
  });
}

py::object judge_mesh(const SharedMesh& mesh, const std::string& printer_file, double min_wall_mm,
                      double min_gap_mm, double overhang_deg) {
  const mesh::Printer printer = printer_of(printer_file, min_wall_mm, min_gap_mm, overhang_deg);
  const mesh::MeshVerdict verdict = run([&](const Progress& progress) {
    return mesh::check_print(mesh.mesh(), printer, 0, progress);
  });
  cli::Json json = cli::to_json(verdict);
  json["triangles"] = mesh.mesh().triangles.size();
  return from_json(json);
}

/// The mesh and what was done to it, with the keys of `argil repair --json`.
py::tuple repair(const SharedMesh& mesh, double voxel_mm, double thicken_mm, bool inward,
                 bool has_round_rim) {
  io::RepairOptions options;
  options.voxel_mm = voxel_mm;
  options.thickening.thickness_mm = thicken_mm;
  options.thickening.inward = inward;
  if (has_round_rim) options.thickening.rim = mesh::SheetRim::round;
  io::RepairedMesh repaired = run(
      [&](const Progress& progress) { return io::repair_mesh(mesh.mesh(), options, progress); });
  const py::object report =
      from_json(cli::repair_json(repaired.report, repaired.mesh.triangles.size()));
  return py::make_tuple(std::make_shared<SharedMesh>(std::move(repaired.mesh)), report);
}

template <class T>
py::array_t<T> triples_in_place(const T* data, std::size_t count, py::handle owner) {
  return view_of(data, {static_cast<py::ssize_t>(count), 3}, owner);
}

}  // namespace

mesh::Printer printer_of(const std::string& file, double min_wall_mm, double min_gap_mm,
                         double overhang_deg) {
  mesh::Printer printer;
  if (!file.empty()) printer = value_of(io::read_printer(file));
  if (!(min_wall_mm >= 0.0 && min_gap_mm >= 0.0 && overhang_deg >= 0.0 && overhang_deg < 90.0)) {
    raise_bad_input(
        "min_wall_mm, min_gap_mm and overhang_deg must be 0 or more, the last below 90");
  }
  if (min_wall_mm > 0.0) printer.min_wall_mm = min_wall_mm;
  if (min_gap_mm > 0.0) printer.min_gap_mm = min_gap_mm;
  if (overhang_deg > 0.0) printer.max_overhang_deg = overhang_deg;
  return printer;
}

void add_meshes(py::module_& module) {
  py::class_<SharedMesh, std::shared_ptr<SharedMesh>>(module, "Mesh")
      .def(py::init(&mesh_of_arrays), py::arg("vertices"), py::arg("faces"),
           py::arg("normals") = py::none())
      .def_static("read", &read, py::arg("file"), py::arg("unit"), py::arg("up"))
      .def("write", &write, py::arg("file"), py::arg("title"))
      .def("vertices",
           [](const py::object& self) {
             const TriangleMesh& mesh = self.cast<const SharedMesh&>().mesh();
             return triples_in_place(reinterpret_cast<const double*>(mesh.positions.data()),
                                     mesh.positions.size(), self);
           })
      .def("normals",
           [](const py::object& self) {
             const TriangleMesh& mesh = self.cast<const SharedMesh&>().mesh();
             return triples_in_place(reinterpret_cast<const double*>(mesh.normals.data()),
                                     mesh.normals.size(), self);
           })
      .def("faces",
           [](const py::object& self) {
             const TriangleMesh& mesh = self.cast<const SharedMesh&>().mesh();
             return triples_in_place(reinterpret_cast<const std::uint32_t*>(mesh.triangles.data()),
                                     mesh.triangles.size(), self);
           })
      .def("volume_mm3", [](const SharedMesh& self) { return signed_volume(self.mesh()); })
      .def("area_mm2", [](const SharedMesh& self) { return surface_area(self.mesh()); })
      .def("check", &judge_mesh, py::arg("printer"), py::arg("min_wall_mm"), py::arg("min_gap_mm"),
           py::arg("overhang_deg"))
      .def("repair", &repair, py::arg("voxel_mm"), py::arg("thicken_mm"), py::arg("inward"),
           py::arg("has_round_rim"));
}

}  // namespace argil::python
