// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes as commands read them: units and axes as the command line or the file says.
#include "mesh_input.h"

#include <array>
#include <utility>

#include "common/options.h"
#include "common/project.h"

namespace argil::cli {
namespace {

constexpr std::array kUnits{io::LengthUnit::mm, io::LengthUnit::cm, io::LengthUnit::m,
                            io::LengthUnit::in};
constexpr std::array kUps{io::UpAxis::y, io::UpAxis::z};

const char* axis_name(io::UpAxis axis) { return axis == io::UpAxis::y ? "y" : "z"; }

const char* source_name(io::FrameSource source) {
  if (source == io::FrameSource::given) return "given";
  return source == io::FrameSource::file ? "file" : "assumed";
}

}  // namespace

void MeshFrameOptions::add_to(CLI::App& command) {
  unit_given_ = add_choice(command, "--unit", unit_, {"mm", "cm", "m", "in"},
                           "unit of the file's numbers; default: as it states, else mm");
  up_given_ = add_choice(command, "--up", up_, {"y", "z"},
                         "axis of the file that points up; default: as it states, else z");
}

io::MeshFrame MeshFrameOptions::frame() const {
  io::MeshFrame frame;
  if (unit_given_->count() > 0) frame.unit = kUnits[unit_];
  if (up_given_->count() > 0) frame.up = kUps[up_];
  return frame;
}

Result<io::FramedMesh> open_mesh(const std::filesystem::path& file,
                                 const MeshFrameOptions& options) {
  auto read = io::read_framed_mesh(file, options.frame());
  if (read) print_notes(io::frame_doubts(file, read.value().frame));
  return read;
}

Result<void> check_no_frame(const std::filesystem::path& project, const MeshFrameOptions& options) {
  if (!options.is_given()) return {};
  return Error{ErrorKind::bad_input, "'" + project.string() +
                                         "' is a project, in mm and z up; leave out --unit and "
                                         "--up"};
}

void add_frame_keys(Json& json, const io::FrameReport& frame) {
  json["unit"] = {{"value", io::unit_name(frame.unit)},
                  {"source", source_name(frame.unit_source)},
                  {"looks_like", nullptr}};
  if (frame.unit_looks_like) json["unit"]["looks_like"] = io::unit_name(*frame.unit_looks_like);
  json["up"] = {{"value", axis_name(frame.up)},
                {"source", source_name(frame.up_source)},
                {"looks_like", nullptr}};
  if (frame.up_looks_like) json["up"]["looks_like"] = axis_name(*frame.up_looks_like);
}

}  // namespace argil::cli
