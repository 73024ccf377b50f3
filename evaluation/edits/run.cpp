// SPDX-License-Identifier: GPL-3.0-or-later
// The same strokes on the same ball by Argil and by Blender, in turn for each size; then, on the
// smallest, once more with edges a quarter as long, which tells how exact the first were.
#include "edits/run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "blender/screen.h"
#include "chart/chart.h"
#include "common/output.h"
#include "edits/accuracy.h"
#include "edits/argil_strokes.h"
#include "edits/blender.h"

namespace argil::evaluation {
namespace {

struct ArgilTool {
  Brush brush;
  Action action;
  bool is_slow;  ///< it takes seconds a dab with the largest tool
};
/// Drawing is done by what stamps a ball and by what displaces with a falloff, as Blender does.
constexpr std::array kArgilTools{
    ArgilTool{Brush::draw, Action::add, false},     ArgilTool{Brush::draw, Action::carve, false},
    ArgilTool{Brush::draw, Action::inflate, true},  ArgilTool{Brush::smooth, Action::smooth, false},
    ArgilTool{Brush::crease, Action::crease, true}, ArgilTool{Brush::grab, Action::grab, true}};

/// How many edges the finer stroke has for each of the other's.
constexpr int kFiner = 4;
/// Of a row that moved the surface by less, in voxels, nothing is to be told.
constexpr double kLeastMoved = 0.05;
/// Vertices under a dab of a slow tool, on all balls but the smallest.
constexpr double kMostWithSlow = 1e3;
/// Dynamic topology takes 0.9 GB for half a million vertices.
constexpr double kMostDyntopo = 2.5e6;
/// Edges of dynamic topology are 0.4 to 1 of what it is asked for, some 0.7 in the mean; those of
/// even triangles, with a vertex for 2/3 voxel^2, are 0.88 voxels long.
constexpr double kDyntopoEdge = 1.25;
/// Of dynamic topology, whose undo of one stroke takes a second for half a million vertices.
constexpr int kDyntopoRepeats = 2;

/// Sizes of the chart.
struct EditSizes {
  std::vector<double> vertices;
  std::vector<double> covered;
  std::vector<double> accuracy_covered;  ///< on the first of `vertices`
  int repeats = 1;
};

EditSizes sizes_of(bool quick) {
  if (quick) return {{4'000.0}, {50.0, 200.0}, {200.0}, 2};
  return {{0.5e6, 2e6, 8e6}, {1e3, 1e4, 5e4}, {1e3, 1e4}, 5};
}

std::string count_text(double count) { return cli::grouped(std::llround(count)); }

/// The smallest ball's strokes, whose error is still to be measured.
struct Unproven {
  std::size_t row;
  StrokePlan plan;
  Action action;  ///< of Argil's rows
  TriangleMesh result;
};

bool is_one_of(double value, const std::vector<double>& values) {
  return std::find(values.begin(), values.end(), value) != values.end();
}

class EditsRun {
 public:
  EditsRun(EditSizes sizes, const Progress& progress)
      : sizes_(std::move(sizes)), progress_(progress), obstacle_(screen_obstacle()) {
    if (!obstacle_.empty()) result_.skipped.push_back(obstacle_);
    result_.skipped.emplace_back("SculptGL: no package of npm brings it (docs/sessions.md)");
  }

  Result<void> run() {
    for (const double vertices : sizes_.vertices) {
      if (auto done = time_argil(vertices); !done) return done;
      if (!obstacle_.empty()) continue;
      if (auto done = time_blender(vertices); !done) return done;
    }
    if (auto done = prove_argil(); !done) return done;
    return obstacle_.empty() ? prove_blender() : Result<void>();
  }
  EditResult take() { return std::move(result_); }

 private:
  double first() const { return sizes_.vertices.front(); }
  BumpyBall ball_of(double vertices) const { return {kBallMm, voxel_for(vertices)}; }
  bool is_proven(double vertices, double covered) const {
    return vertices == first() && is_one_of(covered, sizes_.accuracy_covered);
  }
  Result<void> tell_next(const std::string& stage) {
    // Tools and brushes of all sizes, then of the finer strokes.
    const double steps = static_cast<double>(sizes_.vertices.size() * sizes_.covered.size() +
                                             2 * sizes_.accuracy_covered.size()) *
                         static_cast<double>(kArgilTools.size());
    return tell(progress_, stage, std::min(1.0, told_++ / steps));
  }

  EditRow row_of(const StrokePlan& plan, double vertices, double covered) const {
    EditRow row;
    row.brush = plan.brush;
    row.vertices = vertices;
    row.covered = covered;
    row.radius_mm = plan.radius_mm;
    row.voxel_mm = voxel_for(vertices);
    return row;
  }

  Result<void> time_argil(double vertices) {
    if (auto go = tell_next("Argil"); !go) return go;
    auto clay = clay_of(ball_of(vertices), voxel_for(vertices));
    if (!clay) return clay.error();
    ArgilBench bench(ball_of(vertices), std::move(clay).value());
    for (const ArgilTool& tool : kArgilTools) {
      for (const double covered : sizes_.covered) {
        if (auto go = tell_next("Argil"); !go) return go;
        if (tool.is_slow && vertices > first() && covered > kMostWithSlow) {
          skip(argil_row(bench, tool, vertices, covered), "up to seconds a dab on the first ball");
          continue;
        }
        if (auto done = time_argil_tool(bench, tool, vertices, covered); !done) return done;
      }
    }
    return {};
  }

  EditRow argil_row(const ArgilBench& bench, const ArgilTool& tool, double vertices,
                    double covered) const {
    const StrokePlan plan = stroke_plan(tool.brush, covered, vertices);
    EditRow row = row_of(plan, vertices, covered);
    row.tool = info_of(tool.action).name;
    row.covered_vertices = bench.covered_by(plan, tool.action);
    return row;
  }

  Result<void> time_argil_tool(ArgilBench& bench, const ArgilTool& tool, double vertices,
                               double covered) {
    const StrokePlan plan = stroke_plan(tool.brush, covered, vertices);
    EditRow row = argil_row(bench, tool, vertices, covered);
    if (auto done = bench.time(plan, tool.action, sizes_.repeats, row); !done) return done;
    if (!is_kept(row)) return {};
    if (is_proven(vertices, covered)) {
      auto made = bench.result_of(plan, tool.action);
      if (!made) return made.error();
      unproven_.push_back({result_.rows.size() - 1, plan, tool.action,
                           part_near_stroke(made.value(), plan, kBlenderReach)});
    }
    return {};
  }

  /// A row that did nothing is left out by name: it would look fast.
  bool is_kept(const EditRow& row) {
    const bool is_kept = row.moved_mm > kLeastMoved * row.voxel_mm;
    if (is_kept) {
      result_.rows.push_back(row);
    } else {
      skip(row, "it moved nothing");
    }
    return is_kept;
  }

  void skip(const EditRow& row, const std::string& why) {
    result_.skipped.push_back(std::string(editor_name(row.editor)) + ", " + row.tool + ", " +
                              count_text(row.covered) + " of " + count_text(row.vertices) +
                              " vertices: " + why);
  }

  std::vector<BlenderCase> blender_cases(double vertices) {
    std::vector<BlenderCase> cases;
    const auto add = [&](Editor editor, Brush brush, double covered, int repeats) {
      cases.push_back({editor, stroke_plan(brush, covered, vertices), repeats,
                       detail_mm(editor, voxel_for(vertices))});
      covered_.push_back(covered);
    };
    covered_.clear();
    for (const Brush brush : kBrushes) {
      for (const double covered : sizes_.covered) {
        add(Editor::plain, brush, covered, sizes_.repeats);
      }
    }
    if (vertices > first()) {
      result_.skipped.push_back("Blender's voxel remesher, " + count_text(vertices) +
                                " vertices: a minute for each stroke of two million");
    }
    if (vertices > kMostDyntopo) {
      result_.skipped.push_back("Blender's dynamic topology, " + count_text(vertices) +
                                " vertices: above 12 GB");
      return cases;
    }
    const bool is_first = vertices == first();
    const double usual = sizes_.accuracy_covered.back();
    for (const Brush brush : kBrushes) {
      for (const double covered : sizes_.covered) {
        // Of its largest tool, which takes a second a dab, and of grab, which moves the mesh as it
        // is, one row each.
        const bool is_wanted = covered <= usual || (is_first && brush == Brush::draw);
        const bool is_dyntopo = brush == Brush::draw || (is_first && brush != Brush::grab);
        if (is_wanted && (is_dyntopo || (is_first && covered == usual))) {
          add(Editor::dyntopo, brush, covered, is_first ? kDyntopoRepeats : 1);
        }
        if (covered == usual && is_first) {
          add(Editor::remesh, brush, covered, 0);
        }
      }
    }
    return cases;
  }

  /// Voxels of the remesher as those of a clay with as many vertices, and as long edges of dynamic
  /// topology as leave the mesh as dense as it is.
  static double detail_mm(Editor editor, double voxel_mm) {
    return editor == Editor::dyntopo ? kDyntopoEdge * voxel_mm : voxel_mm;
  }

  Result<void> time_blender(double vertices) {
    const std::vector<BlenderCase> cases = blender_cases(vertices);
    auto answers = run_blender(ball_of(vertices), squares_for(vertices), cases, progress_);
    if (!answers) return blender_failed(answers.error());
    std::map<std::pair<Brush, double>, StrokeTimes> plain;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      BlenderAnswer& answer = answers.value()[i];
      const auto place = std::pair(cases[i].plan.brush, covered_[i]);
      if (cases[i].editor == Editor::plain) plain[place] = answer.times;
      if (cases[i].editor == Editor::remesh) {
        // Its stroke is the plain one.
        const StrokeTime once = answer.times.once;
        answer.times = plain[place];
        answer.times.once = once;
      }
      add_blender_row(cases[i], covered_[i], vertices, std::move(answer));
    }
    return {};
  }

  /// Another program's trouble is told and leaves the rest as it is.
  Result<void> blender_failed(const Error& error) {
    if (error.kind != ErrorKind::internal) return error;
    obstacle_ = error.message;
    result_.skipped.push_back(error.message);
    return {};
  }

  void add_blender_row(const BlenderCase& one, double covered, double vertices,
                       BlenderAnswer answer) {
    EditRow row = row_of(one.plan, vertices, covered);
    row.editor = one.editor;
    row.tool = blender_brush_name(one.plan.brush);
    row.covered_vertices = answer.covered;
    row.times = answer.times;
    if (!answer.complaint.empty()) return skip(row, answer.complaint);
    const BumpyBall ball = ball_of(vertices);
    for (const Vec3& p : answer.result.positions) {
      if (is_near(one.plan, p, kStrokeReach)) {
        row.moved_mm = std::max(row.moved_mm, std::abs(ball.distance(p)));
      }
    }
    // All dabs of a stroke together reach some three times what one does; grab stays in one place.
    const double least = one.plan.brush == Brush::grab ? 0.5 : 2.0;
    if (one.editor == Editor::plain &&
        static_cast<double>(answer.moved) < least * static_cast<double>(answer.covered)) {
      return skip(row, "it moved " + std::to_string(answer.moved) + " vertices only");
    }
    if (is_kept(row) && is_proven(vertices, covered)) {
      blender_unproven_.push_back(
          {result_.rows.size() - 1, one.plan, Action::add, std::move(answer.result)});
    }
  }

  Result<void> prove_argil() {
    if (auto go = tell_next("Argil, finer"); !go) return go;
    auto clay = clay_of(ball_of(first()), voxel_for(first()) / kFiner);
    if (!clay) return clay.error();
    ArgilBench bench(ball_of(first()), std::move(clay).value());
    for (Unproven& one : unproven_) {
      if (auto go = tell_next("Argil, finer"); !go) return go;
      auto made = bench.result_of(one.plan, one.action);
      if (!made) return made.error();
      const TriangleMesh finer = part_near_stroke(made.value(), one.plan, kBlenderReach);
      EditError error{spread_between(one.result, finer, one.plan), {}, 0.0};
      error.longest_edge_mm = longest_edge_mm(one.result, one.plan);
      if (one.action == Action::add || one.action == Action::carve) {
        error.to_swept =
            spread_to_shape(one.result, finer, swept_shape(one.plan, one.action), one.plan);
      }
      result_.rows[one.row].error = error;
    }
    return {};
  }

  ShapeFunction swept_shape(const StrokePlan& plan, Action action) const {
    return [ball = ball_of(first()), stroke = argil_stroke(plan, action)](const Vec3& p) {
      const double tool = distance_to_swept_ball(stroke, p);
      return stroke.tool.action == Action::add ? std::min(ball.distance(p), tool)
                                               : std::max(ball.distance(p), -tool);
    };
  }

  /// Where dynamic topology refines the mesh, a brush has another law, and is held against itself
  /// with finer detail. All else is held against the brush on a finer mesh.
  Result<void> prove_blender() {
    if (auto done = prove_blender(Editor::plain, kFiner * squares_for(first())); !done) return done;
    return prove_blender(Editor::dyntopo, squares_for(first()));
  }

  Editor reference_of(const Unproven& one) const {
    const bool refines = one.plan.brush == Brush::draw || one.plan.brush == Brush::crease;
    return refines && result_.rows[one.row].editor == Editor::dyntopo ? Editor::dyntopo
                                                                      : Editor::plain;
  }

  Result<void> prove_blender(Editor reference, int squares) {
    const double detail = detail_mm(reference, voxel_for(first()) / kFiner);
    std::vector<BlenderCase> cases;
    std::map<std::pair<Brush, double>, std::size_t> number;
    for (const Unproven& one : blender_unproven_) {
      const auto place = std::pair(one.plan.brush, one.plan.radius_mm);
      if (reference_of(one) != reference || !number.try_emplace(place, cases.size()).second) {
        continue;
      }
      cases.push_back({reference, one.plan, 0, detail});
    }
    if (cases.empty()) return {};
    auto answers = run_blender(ball_of(first()), squares, cases, progress_);
    if (!answers) return blender_failed(answers.error());
    for (const Unproven& one : blender_unproven_) {
      if (reference_of(one) != reference) continue;
      if (auto go = tell_next("Blender, finer"); !go) return go;
      prove(one, answers.value()[number[std::pair(one.plan.brush, one.plan.radius_mm)]]);
    }
    return {};
  }

  void prove(const Unproven& one, const BlenderAnswer& finer) {
    if (!finer.complaint.empty()) {
      return skip(result_.rows[one.row], "no finer stroke to compare with: " + finer.complaint);
    }
    EditError error{spread_between(one.result, finer.result, one.plan), {}, 0.0};
    error.longest_edge_mm = longest_edge_mm(one.result, one.plan);
    result_.rows[one.row].error = error;
  }

  EditSizes sizes_;
  const Progress& progress_;
  std::string obstacle_;
  EditResult result_;
  std::vector<Unproven> unproven_;
  std::vector<Unproven> blender_unproven_;
  std::vector<double> covered_;  ///< of the cases of blender_cases
  double told_ = 0.0;
};

}  // namespace

Result<EditResult> measure_edits(bool quick, const Progress& progress) {
  EditsRun run(sizes_of(quick), progress);
  if (auto done = run.run(); !done) return done.error();
  return run.take();
}

}  // namespace argil::evaluation
