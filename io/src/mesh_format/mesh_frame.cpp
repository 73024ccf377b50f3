// SPDX-License-Identifier: GPL-3.0-or-later
// Units and axes of mesh files: applied where they are given or stated, guessed where they are not.
#include "argil/io/mesh_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

#include "argil/core/no_throw.h"
#include "argil/io/assembly.h"

#include "file/file_bytes.h"
#include "format/xml_text.h"
#include "mesh_format/face_collector.h"
#include "mesh_format/mesh_frame_read.h"
#include "mesh_format/mesh_read.h"
#include "mesh_format/mesh_write.h"

namespace argil::io {
namespace {

struct UnitLength {
  const char* name;
  double mm;
};
// In the order of LengthUnit.
constexpr std::array<UnitLength, 6> kUnits{
    {{"um", 0.001}, {"mm", 1.0}, {"cm", 10.0}, {"m", 1000.0}, {"in", 25.4}, {"ft", 304.8}}};

/// The units of 3MF are these six.
LengthUnit unit_of(double mm) noexcept {
  const auto found = std::find_if(kUnits.begin(), kUnits.end(),
                                  [mm](const UnitLength& unit) { return unit.mm == mm; });
  return static_cast<LengthUnit>(found == kUnits.end() ? 1 : found - kUnits.begin());
}

template <class Value>
void settle(const std::optional<Value>& given, std::optional<Value> stated, Value& value,
            FrameSource& source) {
  source = given ? FrameSource::given : stated ? FrameSource::file : FrameSource::assumed;
  if (given) value = *given;
  if (!given && stated) value = *stated;
}

/// The form of glTF that is only read.
bool is_gltf_text(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ending == ".gltf";
}

Box3 bounds_of(const Assembly& assembly) {
  Box3 box;
  for (const AssemblyItem& item : assembly.items) {
    for (const PlacedObject& placed : item.placements) {
      const Box3 own = placed_bounds(assembly.objects[placed.object].mesh, placed.to_mm);
      box.include(own.min);
      box.include(own.max);
    }
  }
  return box;
}

Result<MeshFormat> format_to_read(const std::filesystem::path& file) {
  if (is_gltf_text(file)) return MeshFormat::glb;
  return mesh_format_of(file);
}

/// Multiplies by the unit of a format that states none.
Result<void> scale(TriangleMesh& mesh, LengthUnit unit, const std::string& name) {
  if (unit == LengthUnit::mm) return {};
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    mesh.positions[v] *= length_mm(unit);
    const std::string problem =
        position_problem(mesh.positions[v], " of vertex " + std::to_string(v + 1));
    if (problem.empty()) continue;
    return Error{ErrorKind::bad_input, name + ": in " + unit_name(unit) + ", " + problem};
  }
  return {};
}

/// A quarter turn about x, exact: up from y to z, or back.
void turn(TriangleMesh& mesh, UpAxis from) noexcept {
  for (Vec3& p : mesh.positions)
    p = from == UpAxis::y ? Vec3{p.x, -p.z, p.y} : Vec3{p.x, p.z, -p.y};
}

class FrameReader {
 public:
  FrameReader(const std::filesystem::path& file, const MeshFrame& wanted)
      : file_(file), name_(file.string()), wanted_(wanted) {}

  Result<ReadAssembly> read();

 private:
  Result<TriangleMesh> read_gltf(std::span<const std::byte> bytes);
  Result<ReadAssembly> read_3mf(std::span<const std::byte> bytes);
  Result<TriangleMesh> read_unstated(MeshFormat format, std::span<const std::byte> bytes);

  const std::filesystem::path& file_;
  const std::string name_;
  const MeshFrame& wanted_;
  FrameReport report_;
};

Result<TriangleMesh> FrameReader::read_gltf(std::span<const std::byte> bytes) {
  settle<LengthUnit>(wanted_.unit, LengthUnit::m, report_.unit, report_.unit_source);
  settle<UpAxis>(wanted_.up, UpAxis::y, report_.up, report_.up_source);
  const double unit_mm = length_mm(report_.unit);
  const ReadBeside beside = [&](const std::string& other) {
    return read_file_bytes(file_.parent_path() / other);
  };
  auto mesh = is_gltf_text(file_) ? parse_gltf_in(bytes, name_, beside, unit_mm)
                                  : parse_glb_in(bytes, name_, beside, unit_mm);
  // The reader took y for up.
  if (mesh && report_.up == UpAxis::z) turn(mesh.value(), UpAxis::z);
  return mesh;
}

Result<ReadAssembly> FrameReader::read_3mf(std::span<const std::byte> bytes) {
  StatedUnit unit;
  if (wanted_.unit) unit.instead_mm = length_mm(*wanted_.unit);
  auto parsed = parse_3mf(bytes, name_, unit);
  if (!parsed) return parsed.error();
  settle<LengthUnit>(wanted_.unit, unit_of(unit.mm), report_.unit, report_.unit_source);
  settle<UpAxis>(wanted_.up, UpAxis::z, report_.up, report_.up_source);
  Assembly& assembly = parsed.value().assembly;
  for (AssemblyItem& item : assembly.items) {
    if (report_.up == UpAxis::z) break;
    constexpr Affine kUpright{{Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{0, -1, 0}, Vec3{}}};
    for (PlacedObject& placed : item.placements) placed.to_mm = placed.to_mm.then(kUpright);
  }
  return ReadAssembly{std::move(assembly), report_, std::move(parsed.value().notes)};
}

Result<TriangleMesh> FrameReader::read_unstated(MeshFormat format,
                                                std::span<const std::byte> bytes) {
  settle<LengthUnit>(wanted_.unit, {}, report_.unit, report_.unit_source);
  settle<UpAxis>(wanted_.up, {}, report_.up, report_.up_source);
  auto mesh = format == MeshFormat::obj   ? parse_obj(bytes, name_)
              : format == MeshFormat::stl ? parse_stl(bytes, name_)
                                          : parse_ply(bytes, name_);
  if (!mesh) return mesh;
  if (auto scaled = scale(mesh.value(), report_.unit, name_); !scaled) return scaled.error();
  if (report_.up == UpAxis::y) turn(mesh.value(), UpAxis::y);
  return mesh;
}

Result<ReadAssembly> FrameReader::read() {
  const Result<MeshFormat> format = format_to_read(file_);
  if (!format) return format.error();
  const Result<UnwrittenBytes> bytes = read_file_bytes(file_);
  if (!bytes) return bytes.error();
  if (bytes.value().empty()) {
    return Error{ErrorKind::bad_input, name_ + " is empty; export the mesh again"};
  }
  if (format.value() == MeshFormat::threemf) return read_3mf(bytes.value());
  auto mesh = format.value() == MeshFormat::glb ? read_gltf(bytes.value())
                                                : read_unstated(format.value(), bytes.value());
  if (!mesh) return mesh.error();
  ReadAssembly read;
  read.frame = report_;
  read.assembly.objects.push_back(
      {plain_name(file_.stem().string(), Assembly::kLongestName), {}, std::move(mesh).value()});
  read.assembly.items.push_back({"", {PlacedObject{}}});
  return read;
}

/// Smaller than anything that is sculpted or printed, larger than any printer, and the least of
/// what is usual.
constexpr double kTinyMm = 3.0;
constexpr double kHugeMm = 10'000.0;
constexpr double kUsualMm = 20.0;

std::optional<LengthUnit> better_unit(const FrameReport& report, MeshFormat format) noexcept {
  const double side = report.largest_side_mm;
  if (report.unit_source == FrameSource::assumed && side > 0.0 && side < kTinyMm) {
    return side * length_mm(LengthUnit::in) >= kUsualMm ? LengthUnit::in : LengthUnit::m;
  }
  const bool is_stated_by_gltf =
      report.unit_source == FrameSource::file && format == MeshFormat::glb;
  if (is_stated_by_gltf && side > kHugeMm) return LengthUnit::mm;
  return std::nullopt;
}

/// Which part of the floor plan rests on the lowest plane along this axis.
double resting_part(const TriangleMesh& mesh, const Box3& box, std::size_t axis) noexcept {
  constexpr double kThin = 1e-3;  // of the height
  const Vec3 size = box.size();
  const double top = box.min[axis] + kThin * size[axis];
  const double plan = size[(axis + 1) % 3] * size[(axis + 2) % 3];
  double area = 0.0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Vec3& a = mesh.positions[i];
    const Vec3& b = mesh.positions[j];
    const Vec3& c = mesh.positions[k];
    if (std::max({a[axis], b[axis], c[axis]}) > top) continue;
    area += std::max(0.0, -0.5 * cross(b - a, c - a)[axis]);
  }
  return plan > 0.0 ? area / plan : 0.0;
}

/// As sculptures do that were made with y up: on y = 0, their middle above the origin.
bool stands_on_y_zero(const Box3& box) noexcept {
  const Vec3 size = box.size();
  const Vec3 middle = box.center();
  return std::abs(box.min.y) <= 1e-3 * size.y && std::abs(middle.x) <= 0.1 * size.x &&
         box.min.z < -0.1 * size.z && box.max.z > 0.1 * size.z;
}

bool looks_turned(const TriangleMesh& mesh, const Box3& box) noexcept {
  constexpr std::size_t kY = 1;
  constexpr std::size_t kZ = 2;
  constexpr double kBase = 0.1;
  constexpr double kNone = 0.01;
  if (resting_part(mesh, box, kZ) > kNone) return false;
  return resting_part(mesh, box, kY) >= kBase || stands_on_y_zero(box);
}

std::string six_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

}  // namespace

double length_mm(LengthUnit unit) noexcept { return kUnits[static_cast<std::size_t>(unit)].mm; }

const char* unit_name(LengthUnit unit) noexcept {
  return kUnits[static_cast<std::size_t>(unit)].name;
}

Result<ReadAssembly> read_in_frame(const std::filesystem::path& file, const MeshFrame& wanted) {
  return no_throw(file.string(), [&] { return FrameReader(file, wanted).read(); });
}

Result<FramedMesh> read_framed_mesh(const std::filesystem::path& file, const MeshFrame& wanted) {
  auto read = read_assembly(file, wanted);
  if (!read) return read.error();
  return no_throw(file.string(), [&]() -> Result<FramedMesh> {
    return FramedMesh{joined(std::move(read.value().assembly)), read.value().frame};
  });
}

Result<ReadAssembly> read_assembly(const std::filesystem::path& file, const MeshFrame& wanted) {
  auto read = read_in_frame(file, wanted);
  if (!read) return read;
  const Assembly& assembly = read.value().assembly;
  FrameReport& frame = read.value().frame;
  const Box3 box = bounds_of(assembly);
  const Vec3 size = box.size();
  frame.largest_side_mm = std::max({size.x, size.y, size.z});
  frame.unit_looks_like = better_unit(frame, format_to_read(file).value());
  // Formats of several parts say which axis is up.
  const bool may_be_turned =
      frame.up_source == FrameSource::assumed && assembly.objects.size() == 1;
  if (may_be_turned && looks_turned(assembly.objects[0].mesh, box)) frame.up_looks_like = UpAxis::y;
  return read;
}

std::vector<std::string> frame_doubts(const std::filesystem::path& file, const FrameReport& frame) {
  std::vector<std::string> doubts;
  const std::string name = file.string().insert(0, 1, '\'') + "'";
  if (frame.unit_looks_like) {
    const char* better = unit_name(*frame.unit_looks_like);
    const double side = frame.largest_side_mm / length_mm(frame.unit);
    const bool is_stated = frame.unit_source == FrameSource::file;
    doubts.push_back(name + (is_stated ? " states the unit " : " states no unit, and in ") +
                     unit_name(frame.unit) + (is_stated ? ", by which it is " : " it is ") +
                     six_digits(frame.largest_side_mm) + " mm across; if its numbers are " +
                     better + " (" + six_digits(side * length_mm(*frame.unit_looks_like)) +
                     " mm), give --unit " + better);
  }
  if (frame.up_looks_like) {
    doubts.push_back(name +
                     " does not say which axis is up, and was read with z up, but looks as if it "
                     "stands along y; if so, give --up y");
  }
  return doubts;
}

}  // namespace argil::io
