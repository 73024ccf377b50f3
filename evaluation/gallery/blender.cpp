// SPDX-License-Identifier: GPL-3.0-or-later
// Runs Blender in a window: writes what blender_gallery.py reads, and reads what that answers.
#include "gallery/blender.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <utility>

#include <nlohmann/json.hpp>

#include "argil/io/safe_file.h"

#include "blender/child.h"
#include "blender/mesh_files.h"
#include "blender/screen.h"
#include "blender/script.h"
#include "common/scratch_folder.h"

namespace argil::evaluation {
namespace {

using nlohmann::json;

constexpr double kGalleryPatienceS = 600.0;

json json_of(const Vec3& p) { return {p.x, p.y, p.z}; }

json stroke_json(const PlateStroke& each, const Vec3& toward) {
  json points = json::array();
  for (const Vec3& p : each.brush.path) points.push_back(json_of(p));
  if (each.brush.path.empty()) {
    for (const StrokeSample& sample : each.stroke.samples) {
      points.push_back(json_of(sample.position_mm));
    }
  }
  return {{"brush", each.brush.name},
          {"radius_mm", smallest_radius(each.stroke.tool)},
          {"strength", each.brush.strength},
          {"settings", each.brush.settings},
          {"points", points},
          {"toward", json_of(toward)}};
}

json case_json(const BlenderPlate& one, std::size_t number, const std::string& result) {
  const Plate& plate = *one.plate;
  json made{{"number", number},
            {"body", body_name(plate.body)},
            {"aim_mm", plate.is_matched ? one.aim_mm : 0.0},
            {"result", result}};
  if (!plate.boolean.empty()) {
    const Stroke& stroke = plate.strokes[0].stroke;
    made["operation"] = plate.boolean;
    made["radius_mm"] = smallest_radius(stroke.tool);
    made["at"] = json_of(stroke.samples[0].position_mm);
    return made;
  }
  for (const PlateStroke& each : plate.strokes) {
    made["strokes"].push_back(stroke_json(each, plate.toward));
  }
  return made;
}

std::vector<json> answers_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<json> answers;
  for (std::string line; std::getline(in, line);) {
    json answer = json::parse(line, nullptr, false);
    if (answer.is_object()) answers.push_back(std::move(answer));
  }
  return answers;
}

BlenderPiece piece_of(const json& answer, const std::filesystem::path& result) {
  BlenderPiece piece;
  piece.complaint = answer.value("error", std::string());
  if (!piece.complaint.empty()) return piece;
  piece.strength = answer.value("strength", 0.0);
  auto mesh = read_mesh_files(result);
  if (!mesh) {
    piece.complaint = "its result is cut off";
    return piece;
  }
  piece.mesh = std::move(*mesh);
  return piece;
}

class GalleryRun {
 public:
  GalleryRun(const std::map<Body, TriangleMesh>& bodies, const std::vector<BlenderPlate>& plates,
             const cli::ScratchFolder& scratch)
      : bodies_(bodies), plates_(plates), scratch_(scratch) {}

  Result<void> write_bodies() const {
    for (const auto& [body, surface] : bodies_) {
      if (auto done = write_mesh_files(path_of(body), surface); !done) return done;
    }
    return io::replace_text(scratch_ / "gallery.py", gallery_script());
  }

  /// Has Blender do all plates. Where it crashes it begins again with the plate after the one that
  /// it was at.
  Result<void> run(const Progress& progress) const {
    auto screen = Screen::open(scratch_, progress);
    if (!screen) return screen.error();
    const auto all = static_cast<double>(plates_.size());
    for (std::size_t first = 0; first < plates_.size();) {
      if (auto written = write_job(first); !written) return written;
      if (auto ended = run_blender_child(
              {scratch_, "gallery.py", "job.json", screen.value().display(), kGalleryPatienceS,
               [&] { return static_cast<double>(answered()) / all; }},
              progress);
          !ended) {
        return ended;
      }
      if (answers_in(scratch_ / "answers").empty()) break;  // it never began
      first = std::max(first, answered()) + 1;
    }
    return {};
  }

  Result<BlenderGallery> read() const {
    BlenderGallery gallery;
    gallery.pieces.resize(plates_.size());
    for (BlenderPiece& piece : gallery.pieces) piece.complaint = "Blender crashed";
    for (const auto& [body, surface] : bodies_) {
      auto start = read_mesh_files(path_of(body).string() + ".start");
      if (!start) {
        return Error{ErrorKind::internal,
                     "Blender ends before it has done anything (" + last_said(scratch_) + ")"};
      }
      gallery.starts[body] = std::move(*start);
    }
    for (const json& answer : answers_in(scratch_ / "answers")) {
      if (answer.contains("version")) gallery.version = answer["version"].get<std::string>();
      const auto i = answer.value("case", plates_.size());
      if (i < plates_.size()) gallery.pieces[i] = piece_of(answer, result_of(i));
    }
    return gallery;
  }

 private:
  /// The job, of the plates from this one on.
  Result<void> write_job(std::size_t first) const {
    json job{{"voxel_mm", kGalleryVoxel},
             {"answers", (scratch_ / "answers").string()},
             {"bodies", json::object()},
             {"cases", json::array()}};
    for (const auto& [body, surface] : bodies_) {
      job["bodies"][body_name(body)] = path_of(body).string();
    }
    for (std::size_t i = first; i < plates_.size(); ++i) {
      assert(plates_[i].plate->no_counterpart.empty() && bodies_.contains(plates_[i].plate->body));
      job["cases"].push_back(case_json(plates_[i], i, result_of(i).string()));
    }
    return io::replace_text(scratch_ / "job.json", job.dump());
  }

  /// One more than the number of the last plate that has an answer.
  std::size_t answered() const {
    std::size_t count = 0;
    for (const json& answer : answers_in(scratch_ / "answers")) {
      if (answer.contains("case")) count = answer["case"].get<std::size_t>() + 1;
    }
    return count;
  }

  std::filesystem::path path_of(Body body) const { return scratch_ / body_name(body); }
  std::filesystem::path result_of(std::size_t i) const {
    return scratch_ / ("result" + std::to_string(i));
  }

  const std::map<Body, TriangleMesh>& bodies_;
  const std::vector<BlenderPlate>& plates_;
  const cli::ScratchFolder& scratch_;
};

}  // namespace

Result<BlenderGallery> run_blender_gallery(const std::map<Body, TriangleMesh>& bodies,
                                           const std::vector<BlenderPlate>& plates,
                                           const Progress& progress) {
  assert(!plates.empty());
  const auto scratch = cli::ScratchFolder::make();
  if (!scratch) return scratch.error();
  const GalleryRun run(bodies, plates, scratch.value());
  if (auto written = run.write_bodies(); !written) return written.error();
  if (auto ended = run.run(progress); !ended) return ended.error();
  return run.read();
}

}  // namespace argil::evaluation
