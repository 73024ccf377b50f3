// SPDX-License-Identifier: GPL-3.0-or-later
// Ours first, since Blender is asked to move the surface as far; then all of Blender's in one run.
#include "gallery/run.h"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <map>
#include <utility>

#include "blender/screen.h"
#include "chart/chart.h"
#include "common/output.h"
#include "gallery/blender.h"
#include "gallery/figures.h"
#include "gallery/piece.h"

namespace argil::evaluation {
namespace {

/// Whose reach Blender's strength is sought for.
constexpr int kMatchedLevel = 1;
/// Whose surface its bodies are made of: the finest, since clay is as coarse as its tolerance
/// allows.
constexpr int kBodyLevel = kGalleryLevels - 1;

class GalleryMaker {
 public:
  GalleryMaker(std::vector<Plate> plates, const Progress& progress)
      : progress_(progress), obstacle_(screen_obstacle()) {
    for (Plate& plate : plates) result_.plates.push_back({std::move(plate), {}});
    aims_.resize(result_.plates.size());
  }

  Result<void> make() {
    for (std::size_t n = 0; n < result_.plates.size(); ++n) {
      if (auto done = make_ours(n); !done) return done;
    }
    if (!obstacle_.empty()) {
      result_.skipped.push_back(obstacle_);
    } else if (auto done = make_blenders(); !done) {
      return done;
    }
    for (MadePlate& made : result_.plates) {
      if (made.columns.size() == kGalleryLevels) made.columns.push_back(empty_column(made.plate));
    }
    return {};
  }
  GalleryResult take() { return std::move(result_); }

 private:
  Result<void> tell_next(const char* stage) {
    const auto steps = static_cast<double>(result_.plates.size() * (kGalleryLevels + 1));
    return tell(progress_, stage, std::min(1.0, told_++ / steps));
  }

  /// The surface of a body before the work, made once.
  Result<const TriangleMesh*> start_of(Body body, int level) {
    const auto key = std::pair(body, level);
    if (!starts_.contains(key)) {
      auto surface = body_surface(body, finest_voxel(level), progress_);
      if (!surface) return surface.error();
      starts_[key] = std::move(surface).value();
    }
    return &starts_[key];
  }

  Result<void> make_ours(std::size_t n) {
    MadePlate& made = result_.plates[n];
    for (int level = 0; level < kGalleryLevels; ++level) {
      if (auto go = tell_next("Argil"); !go) return go;
      const double voxel = finest_voxel(level);
      const auto start = start_of(made.plate.body, level);
      if (!start) return start.error();
      auto piece = argil_piece(made.plate, voxel, progress_);
      if (!piece) return piece.error();
      const TriangleMesh& mesh = piece.value().mesh;
      if (level == kMatchedLevel) aims_[n] = reach_of(made.plate.body, mesh).farthest_mm();
      Column column;
      column.maker = "level " + std::to_string(piece.value().level);
      column.with = "voxels of " + cli::number(voxel) + " mm";
      column.figures = figures_of(made.plate, *start.value(), mesh);
      if (auto drawn = draw(made, std::move(column), std::move(piece.value().mesh)); !drawn)
        return drawn;
    }
    return {};
  }

  Result<void> draw(MadePlate& made, Column column, TriangleMesh mesh) {
    auto image = plate_image(made.plate, std::move(mesh), progress_);
    if (!image) return image.error();
    column.image = std::move(image).value();
    made.columns.push_back(std::move(column));
    return {};
  }

  Result<void> make_blenders() {
    std::vector<BlenderPlate> wanted;
    std::vector<std::size_t> numbers;
    std::map<Body, TriangleMesh> bodies;
    for (std::size_t n = 0; n < result_.plates.size(); ++n) {
      const Plate& plate = result_.plates[n].plate;
      if (!plate.no_counterpart.empty()) continue;
      wanted.push_back({&plate, aims_[n]});
      numbers.push_back(n);
      bodies[plate.body] = starts_.at({plate.body, kBodyLevel});
    }
    if (wanted.empty()) return {};
    auto gallery = run_blender_gallery(bodies, wanted, progress_);
    if (!gallery) return blender_failed(gallery.error());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
      if (auto go = tell_next("Blender"); !go) return go;
      if (auto done = add_blenders(result_.plates[numbers[i]], gallery.value(), i); !done)
        return done;
    }
    return {};
  }

  Result<void> add_blenders(MadePlate& made, BlenderGallery& gallery, std::size_t i) {
    BlenderPiece& piece = gallery.pieces[i];
    const Plate& plate = made.plate;
    if (!piece.complaint.empty()) {
      result_.skipped.push_back(std::string("Blender, ") + info_of(plate.action).name + ": " +
                                piece.complaint);
      Column column = empty_column(plate);
      column.reason = piece.complaint;
      made.columns.push_back(std::move(column));
      return {};
    }
    Column column;
    column.maker = "Blender " + gallery.version;
    column.with = plate.boolean.empty() ? plate.strokes.back().brush.name + ", strength " +
                                              strength_text(piece.strength)
                                        : "Boolean with a ball, remeshed";
    column.figures = figures_of(plate, gallery.starts.at(plate.body), piece.mesh);
    return draw(made, std::move(column), std::move(piece.mesh));
  }

  static std::string strength_text(double strength) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", strength);
    return text;
  }

  /// Another program's trouble is told and leaves the rest as it is.
  Result<void> blender_failed(const Error& error) {
    if (error.kind != ErrorKind::internal) return error;
    obstacle_ = error.message;
    result_.skipped.push_back(error.message);
    return {};
  }

  Column empty_column(const Plate& plate) const {
    Column column;
    column.maker = "Blender";
    if (!plate.no_counterpart.empty()) {
      column.with = "nothing alike";
      column.reason = plate.no_counterpart;
    } else {
      column.with = "not run";
      column.reason = obstacle_;
    }
    return column;
  }

  const Progress& progress_;
  std::string obstacle_;
  GalleryResult result_;
  std::vector<double> aims_;
  std::map<std::pair<Body, int>, TriangleMesh> starts_;
  double told_ = 0.0;
};

}  // namespace

Result<GalleryResult> make_gallery(std::vector<Plate> plates, const Progress& progress) {
  GalleryMaker maker(std::move(plates), progress);
  if (auto made = maker.make(); !made) return made.error();
  return maker.take();
}

std::string gallery_csv(const std::vector<MadePlate>& plates) {
  std::string text = "# The figures under the pictures of the gallery; h is " +
                     cli::number(kGalleryVoxel) +
                     " mm, a tenth of the tool's radius\naction,maker,with,figure,unit,value\n";
  for (const MadePlate& made : plates) {
    for (const Column& column : made.columns) {
      for (const Figure& figure : column.figures) {
        std::string with = column.with;
        std::replace(with.begin(), with.end(), ',', ';');
        std::string name = figure.name;
        std::replace(name.begin(), name.end(), ',', ';');
        text.append(info_of(made.plate.action).name).append(",").append(column.maker);
        text.append(",").append(with).append(",").append(name).append(",").append(figure.unit);
        text.append(",").append(cli::number(figure.value)).append("\n");
      }
    }
  }
  return text;
}

}  // namespace argil::evaluation
