// SPDX-License-Identifier: GPL-3.0-or-later
// Runs Blender in a window: writes what blender_strokes.py reads, and reads what that answers.
#include "edits/blender.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <fstream>
#include <span>
#include <utility>

#include <nlohmann/json.hpp>

#include "argil/io/safe_file.h"

#include "blender/child.h"
#include "blender/screen.h"
#include "blender/script.h"
#include "chart/chart.h"
#include "common/scratch_folder.h"

namespace argil::evaluation {
namespace {

using nlohmann::json;

/// How often a case may crash it until it is left out.
constexpr int kMostCrashes = 2;
/// The part of the ball that a stroke may reach, with vertices of its own numbers.
struct BallPart {
  std::vector<std::int32_t> vertices;  ///< their numbers in the ball
  std::vector<std::int32_t> quads;     ///< in numbers of their own
};

Vec3 vertex_of(std::span<const float> positions, std::size_t i) {
  return {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
}

BallPart part_near(const QuadBall& ball, const StrokePlan& plan) {
  BallPart part;
  std::vector<std::int32_t> own(ball.positions.size() / 3, -1);
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (!is_near(plan, vertex_of(ball.positions, i), kBlenderReach)) continue;
    own[i] = static_cast<std::int32_t>(part.vertices.size());
    part.vertices.push_back(static_cast<std::int32_t>(i));
  }
  for (std::size_t at = 0; at < ball.quads.size(); at += 4) {
    std::array<std::int32_t, 4> corners{};
    for (std::size_t i = 0; i < 4; ++i) {
      corners[i] = own[static_cast<std::size_t>(ball.quads[at + i])];
    }
    if (*std::min_element(corners.begin(), corners.end()) < 0) continue;
    part.quads.insert(part.quads.end(), corners.begin(), corners.end());
  }
  return part;
}

const char* mode_name(Editor editor) {
  if (editor == Editor::dyntopo) return "dyntopo";
  return editor == Editor::remesh ? "remesh" : "plain";
}

/// The brush's own strength at which a stroke moves the surface about as far as Argil's: draw by
/// half a radius, grab as far as the hand. Crease sinks by a twentieth for each dab, which overlap,
/// where Argil's lays a profile a quarter deep. Smoothing has Blender's usual one.
double strength_of(Brush brush) {
  switch (brush) {
    case Brush::draw:
      return 0.36;  // squared, times the four radii that the falloffs of overlapping dabs add up to
    case Brush::smooth:
      return 0.7;
    case Brush::crease:
      return 0.2236;  // squared
    case Brush::grab:
      break;
  }
  return 1.0;
}

/// One run of Blender: what it is given, and where its answers are.
class BlenderRun {
 public:
  BlenderRun(const std::vector<BlenderCase>& cases, const QuadBall& ball,
             const cli::ScratchFolder& scratch)
      : cases_(cases), ball_(ball), scratch_(scratch) {}

  Result<void> write_files(const Progress& progress) {
    if (auto done = write_values(path("ball.positions"), ball_.positions); !done) return done;
    if (auto done = write_values(path("ball.quads"), ball_.quads); !done) return done;
    for (std::size_t i = 0; i < cases_.size(); ++i) {
      if (auto go = tell(progress, "Blender", 0.0); !go) return go;
      parts_.push_back(part_near(ball_, cases_[i].plan));
      if (auto done = write_values(path("keep", i), parts_.back().vertices); !done) return done;
    }
    return io::replace_text(path("strokes.py"), strokes_script());
  }

  /// Has Blender do all cases. Where it crashes it begins again with the case that it was at, and
  /// where that crashes it twice, with the next.
  Result<void> run(const std::string& display, const Progress& progress) {
    std::vector<int> crashes(cases_.size());
    for (std::size_t first = 0; first < cases_.size();) {
      if (auto written = write_cases(first); !written) return written;
      if (auto ended = wait(display, progress); !ended) return ended;
      while (first < cases_.size() && has_answer(first)) ++first;
      if (first == cases_.size() || ++crashes[first] < kMostCrashes) continue;
      if (first == 0) {
        return Error{ErrorKind::internal,
                     "Blender ends before it has done anything (" + last_said(scratch_) + ")"};
      }
      ++first;
    }
    return {};
  }

  std::vector<BlenderAnswer> answers() const {
    std::vector<BlenderAnswer> all(cases_.size());
    for (BlenderAnswer& answer : all) answer.complaint = "Blender crashed";
    for (const std::string& line : lines()) {
      const json read = json::parse(line, nullptr, false);
      if (read.is_discarded() || !read.contains("case")) continue;
      const std::size_t i = read["case"].get<std::size_t>();
      if (i < all.size()) all[i] = answer_of(i, read);
    }
    return all;
  }

 private:
  std::string path(const std::string& name) const { return (scratch_ / name).string(); }
  std::string path(const std::string& name, std::size_t i) const {
    return path(name + std::to_string(i));
  }

  /// The job, of the cases from this one on.
  Result<void> write_cases(std::size_t first) const {
    json job{{"positions", path("ball.positions")},
             {"quads", path("ball.quads")},
             {"answers", path("answers")},
             {"cases", json::array()}};
    for (std::size_t i = first; i < cases_.size(); ++i) job["cases"].push_back(json_of(i));
    return io::replace_text(path("job.json"), job.dump());
  }

  bool has_answer(std::size_t i) const {
    const std::string begin = "{\"case\": " + std::to_string(i) + ",";
    const std::vector<std::string> all = lines();
    return std::any_of(all.begin(), all.end(),
                       [&](const std::string& line) { return line.starts_with(begin); });
  }

  /// Waits for Blender's end on this display.
  Result<void> wait(const std::string& display, const Progress& progress) {
    const auto all = static_cast<double>(cases_.size());
    return run_blender_child({scratch_, "strokes.py", "job.json", display, 0.0,
                              [&] { return static_cast<double>(lines().size()) / all; }},
                             progress);
  }

  json json_of(std::size_t i) const {
    const BlenderCase& one = cases_[i];
    json points = json::array();
    for (const Vec3& p : one.plan.points) points.push_back({p.x, p.y, p.z});
    return {{"number", i},
            {"mode", mode_name(one.editor)},
            {"brush", blender_brush_name(one.plan.brush)},
            {"radius_mm", one.plan.radius_mm},
            {"strength", strength_of(one.plan.brush)},
            {"points", points},
            {"short", kShortDabs},
            {"repeats", one.repeats},
            {"detail_mm", one.detail_mm},
            {"keep", path("keep", i)},
            {"result", path("result", i)}};
  }

  std::vector<std::string> lines() const {
    std::ifstream in(path("answers"));
    std::vector<std::string> found;
    for (std::string line; std::getline(in, line);) found.push_back(line);
    return found;
  }

  BlenderAnswer answer_of(std::size_t i, const json& read) const {
    BlenderAnswer answer;
    answer.complaint = read.value("error", std::string());
    if (!answer.complaint.empty()) return answer;
    answer.times.short_stroke = least_of(read["short"]);
    answer.times.long_stroke = least_of(read["long"]);
    answer.times.once = least_of(read["once"]);
    read_result(i, answer);
    return answer;
  }

  static StrokeTime least_of(const json& runs) {
    StrokeTime least;
    for (std::size_t run = 0; run < runs.size(); ++run) {
      const double wall = runs[run][0].get<double>();
      const double cpu = runs[run][1].get<double>();
      least.wall_ms = run == 0 ? wall : std::min(least.wall_ms, wall);
      least.cpu_ms = run == 0 ? cpu : std::min(least.cpu_ms, cpu);
    }
    return least;
  }

  void read_result(std::size_t i, BlenderAnswer& answer) const {
    const BallPart& part = parts_[i];
    const auto positions = read_values<float>(path("result", i) + ".positions");
    std::vector<Vec3> vertices(positions.size() / 3);
    for (std::size_t v = 0; v < vertices.size(); ++v) vertices[v] = vertex_of(positions, v);
    for (const std::int32_t v : part.vertices) {
      const Vec3 p = vertex_of(ball_.positions, static_cast<std::size_t>(v));
      answer.covered += length(p - cases_[i].plan.points[0]) < cases_[i].plan.radius_mm ? 1 : 0;
    }
    if (cases_[i].editor != Editor::plain) {
      const auto corners = read_values<std::uint32_t>(path("result", i) + ".triangles");
      answer.result.positions = std::move(vertices);
      for (std::size_t at = 0; at + 2 < corners.size(); at += 3) {
        answer.result.triangles.push_back({corners[at], corners[at + 1], corners[at + 2]});
      }
      return;
    }
    if (vertices.size() != part.vertices.size()) {
      answer.complaint = "its result is cut off";
      return;
    }
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      const auto was = static_cast<std::size_t>(part.vertices[v]);
      answer.moved += vertices[v] == vertex_of(ball_.positions, was) ? 0 : 1;
    }
    answer.result = triangles_of(part.quads, vertices);
  }

  const std::vector<BlenderCase>& cases_;
  const QuadBall& ball_;
  const cli::ScratchFolder& scratch_;
  std::vector<BallPart> parts_;
};

}  // namespace

const char* blender_brush_name(Brush brush) {
  switch (brush) {
    case Brush::draw:
      return "SculptDraw";
    case Brush::smooth:
      return "Smooth";
    case Brush::crease:
      return "Crease";
    case Brush::grab:
      break;
  }
  return "Grab";
}

Result<std::vector<BlenderAnswer>> run_blender(const BumpyBall& ball, int squares,
                                               const std::vector<BlenderCase>& cases,
                                               const Progress& progress) {
  assert(!cases.empty());
  // Takes seconds, in which an interrupt ends the program where it is: before there is a folder.
  const QuadBall mesh = quad_ball(ball, squares);
  const auto scratch = cli::ScratchFolder::make();
  if (!scratch) return scratch.error();
  BlenderRun run(cases, mesh, scratch.value());
  if (auto written = run.write_files(progress); !written) return written.error();
  auto screen = Screen::open(scratch.value(), progress);
  if (!screen) return screen.error();
  if (auto ended = run.run(screen.value().display(), progress); !ended) return ended.error();
  return run.answers();
}

}  // namespace argil::evaluation
