// SPDX-License-Identifier: GPL-3.0-or-later
// What a mesh shall become: asked before it is imported, beside a picture of how large that is.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <imgui.h>

#include "argil/engine/sculpture.h"

#include "base/text.h"
#include "commands/command.h"
#include "commands/import_choice.h"
#include "gui/dialog.h"
#include "gui/gui.h"
#include "gui/layout.h"
#include "panels/panels.h"

namespace argil::viewer {
namespace {

constexpr float kPictureSide = 290.0F;  // units
constexpr double kFigureMm = 28.0;      // of a miniature that most people have held
constexpr double kBedMm = 220.0;

// ---- the picture -------------------------------------------------------------------------------

/// An oblique drawing: x to the right, z up, and y goes away to the right and up, shortened.
class ScaleDrawing {
 public:
  ScaleDrawing(ImDrawList& list, const ImVec2& low, float side)
      : list_(list), low_(low), side_(side) {}

  /// Chooses the scale that holds these points with a margin.
  void fit(const std::vector<Vec3>& points) {
    Box3 box;
    for (const Vec3& p : points) box.include(flat(p));
    const Vec3 size = box.size();
    const double margin = 0.86 * static_cast<double>(side_);
    scale_ = margin / std::max({size.x, size.y, 1e-6});
    middle_ = box.center();
  }
  double scale() const { return scale_; }

  ImVec2 at(const Vec3& p) const {
    const Vec3 q = scale_ * (flat(p) - middle_);
    return {low_.x + 0.5F * side_ + static_cast<float>(q.x),
            low_.y + 0.5F * side_ - static_cast<float>(q.y)};
  }
  void line(const Vec3& a, const Vec3& b, ImU32 color, float width) {
    list_.AddLine(at(a), at(b), color, width);
  }
  ImDrawList& list() { return list_; }

 private:
  static Vec3 flat(const Vec3& p) {
    constexpr double kAway = 0.35;
    return {p.x + kAway * p.y, p.z + kAway * p.y, 0.0};
  }

  ImDrawList& list_;
  ImVec2 low_;
  float side_;
  double scale_ = 1.0;
  Vec3 middle_;
};

Vec3 corner_of(const Vec3& size, unsigned n) {
  return {(n & 1U) != 0 ? size.x : 0.0, (n & 2U) != 0 ? size.y : 0.0, (n & 4U) != 0 ? size.z : 0.0};
}

std::array<Vec3, 4> bed_under(const Vec3& size) {
  const Vec3 middle{0.5 * size.x, 0.5 * size.y, 0.0};
  const double half = 0.5 * kBedMm;
  return {middle + Vec3{-half, -half, 0.0}, middle + Vec3{half, -half, 0.0},
          middle + Vec3{half, half, 0.0}, middle + Vec3{-half, half, 0.0}};
}

/// Where the figure stands: in front, to the left.
Vec3 figure_place(const Vec3& size) { return {-0.12 * size.x - 12.0, 0.0, 0.0}; }

void draw_bed(ScaleDrawing& drawing, const Vec3& size) {
  const auto bed = bed_under(size);
  const ImU32 color = ImGui::GetColorU32({0.45F, 0.55F, 0.65F, 0.9F});
  for (std::size_t n = 0; n < 4; ++n) drawing.line(bed[n], bed[(n + 1) % 4], color, 1.5F);
}

void draw_figure(ScaleDrawing& drawing, const Vec3& size) {
  const Vec3 feet = figure_place(size);
  const auto at = [&](double x, double z) { return feet + kFigureMm * Vec3{x, 0.0, z}; };
  const ImU32 color = ImGui::GetColorU32({0.75F, 0.82F, 0.90F, 1.0F});
  const float width =
      std::clamp(static_cast<float>(0.06 * kFigureMm * drawing.scale()), 1.0F, 6.0F);
  const auto limb = [&](double x0, double z0, double x1, double z1) {
    drawing.line(at(x0, z0), at(x1, z1), color, width);
  };
  limb(0.0, 0.86, 0.0, 0.48);
  limb(-0.16, 0.50, 0.0, 0.80);
  limb(0.16, 0.50, 0.0, 0.80);
  limb(-0.10, 0.0, 0.0, 0.48);
  limb(0.10, 0.0, 0.0, 0.48);
  const auto radius = static_cast<float>(0.07 * kFigureMm * drawing.scale());
  drawing.list().AddCircleFilled(drawing.at(at(0.0, 0.93)), std::max(radius, 1.5F), color);
}

/// As seen from the front, half way into the box.
void draw_silhouette(ScaleDrawing& drawing, const ImportChoice& choice, const MeshOffer& offer) {
  const bool as_read = choice.up == offer.frame.up;
  const Silhouette& seen = as_read ? offer.along_y : offer.along_z;
  if (seen.rows == 0) return;
  const bool is_upside_down = !as_read && offer.frame.up == io::UpAxis::y;
  const Vec3 size = size_of(choice, offer);
  const ImU32 color = ImGui::GetColorU32({0.75F, 0.45F, 0.28F, 1.0F});
  const auto place = [&](int column, int row) {
    return drawing.at({size.x * column / seen.columns, 0.5 * size.y, size.z * row / seen.rows});
  };
  for (const Silhouette::Run& run : seen.runs) {
    const int row = is_upside_down ? seen.rows - 1 - run.row : run.row;
    const ImVec2 low = place(run.first, row);
    const ImVec2 high = place(run.end, row + 1);
    // A little more than a row, so that none shows between them.
    drawing.list().AddRectFilled({low.x, high.y - 0.5F}, {high.x, low.y + 0.5F}, color);
  }
}

/// The edges behind the silhouette, or those in front of it.
void draw_box(ScaleDrawing& drawing, const Vec3& size, bool is_front) {
  const ImU32 color = ImGui::GetColorU32({0.95F, 0.80F, 0.65F, is_front ? 0.9F : 0.4F});
  for (unsigned n = 0; n < 8; ++n) {
    for (const unsigned along : {1U, 2U, 4U}) {
      if ((n & along) != 0) continue;
      const bool in_front = (n & 2U) == 0 && along != 2U;
      if (in_front == is_front) {
        drawing.line(corner_of(size, n), corner_of(size, n | along), color, 1.0F);
      }
    }
  }
}

void draw_picture(const ImportChoice& choice, const MeshOffer& offer) {
  const float side = kPictureSide * unit();
  const ImVec2 low = ImGui::GetCursorScreenPos();
  const ImVec2 high{low.x + side, low.y + side};
  ImGui::Dummy({side, side});
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(low, high, ImGui::GetColorU32({0.08F, 0.08F, 0.09F, 1.0F}), 4.0F * unit());
  list.PushClipRect(low, high, true);
  const Vec3 size = size_of(choice, offer);
  std::vector<Vec3> points;
  points.reserve(8);
  for (unsigned n = 0; n < 8; ++n) points.push_back(corner_of(size, n));
  const Vec3 feet = figure_place(size);
  points.push_back(feet - Vec3{0.2 * kFigureMm, 0.0, 0.0});
  points.push_back(feet + Vec3{0.0, 0.0, kFigureMm});
  ScaleDrawing drawing(list, low, side);
  drawing.fit(points);
  // The whole bed where that leaves enough of the rest, else what is in the picture of it.
  constexpr double kMostSmaller = 3.0;
  const double wanted = drawing.scale();
  for (const Vec3& corner : bed_under(size)) points.push_back(corner);
  ScaleDrawing with_bed(list, low, side);
  with_bed.fit(points);
  const bool has_bed = kMostSmaller * with_bed.scale() > wanted;
  if (has_bed) drawing.fit(points);
  draw_bed(drawing, size);
  draw_figure(drawing, size);
  draw_box(drawing, size, false);
  draw_silhouette(drawing, choice, offer);
  draw_box(drawing, size, true);
  list.PopClipRect();
  ImGui::TextDisabled(has_bed ? "figure 28 mm, bed 220 x 220 mm"
                              : "figure 28 mm; the bed, 220 mm, is larger");
}

// ---- what can be chosen ------------------------------------------------------------------------

void draw_frame(ImportChoice& choice, const MeshOffer& offer) {
  std::vector<io::LengthUnit> units{io::LengthUnit::mm, io::LengthUnit::cm, io::LengthUnit::m,
                                    io::LengthUnit::in};
  // Those of 3MF alone are offered where the file has them.
  if (std::find(units.begin(), units.end(), offer.frame.unit) == units.end()) {
    units.push_back(offer.frame.unit);
  }
  std::vector<std::string> names;
  names.reserve(units.size());
  for (const io::LengthUnit each : units) names.emplace_back(io::unit_name(each));
  int at = static_cast<int>(std::find(units.begin(), units.end(), choice.unit) - units.begin());
  if (pick_one("Unit of the file", at, names)) {
    set_unit(choice, offer, units[static_cast<std::size_t>(at)]);
  }
  int up = choice.up == io::UpAxis::y ? 0 : 1;
  if (pick_one("Up", up, {"y", "z"})) choice.up = up == 0 ? io::UpAxis::y : io::UpAxis::z;
  for (const std::string& guess : choice.guesses) ImGui::TextDisabled("%s", guess.c_str());
}

void draw_size(ImportChoice& choice, const MeshOffer& offer) {
  constexpr std::array kSides{"Width, mm##import", "Depth, mm##import", "Height, mm##import"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    double mm = size_of(choice, offer)[axis];
    if (number(kSides[axis], mm, 0.0, kMostImportMm, "%.3f")) set_size(choice, offer, axis, mm);
  }
  ImGui::TextDisabled("One changes the others with it.");
}

/// Two digits: an estimate knows no more.
std::string about(double value) {
  const double step = std::pow(10.0, std::floor(std::log10(std::max(value, 10.0))) - 1.0);
  return grouped(static_cast<std::int64_t>(std::round(value / step) * step));
}

void draw_detail(ImportChoice& choice, const MeshOffer& offer) {
  double voxel = choice.voxel_mm;
  if (number("Finest voxel, mm##import", voxel, kLeastVoxelMm, kMostVoxelMm, "%.4g")) {
    set_voxel(choice, voxel);
  }
  const io::ImportOutlook::Cost cost = cost_of(choice, offer);
  ImGui::TextUnformatted(
      ("About " + about(cost.vertices) + " vertices, " + about(cost.bytes / 1e6) + " MB").c_str());
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip("Told from the area and how it is bent; usually right within a quarter");
  }
}

/// Why it cannot be imported so; "" where it can.
std::string obstacle(const ImportChoice& choice, const MeshOffer& offer) {
  const Vec3 size = size_of(choice, offer);
  const double side = std::max({size.x, size.y, size.z});
  if (choice.keeps_parts && offer.parts > Sculpture::kMostPieces) {
    return "At most 1000 parts can be pieces: choose one piece for all.";
  }
  if (side >= kLeastImportMm && side <= kMostImportMm) return "";
  return "The largest side must be 0.01 to 10 000 mm: choose another unit or size.";
}

void draw_choices(ImportChoice& choice, const MeshOffer& offer) {
  ImGui::PushItemWidth(140.0F * unit());
  ImGui::TextUnformatted(choice.file.filename().string().c_str());
  ImGui::TextDisabled("%s triangles", grouped(offer.triangles).c_str());
  draw_frame(choice, offer);
  ImGui::Separator();
  draw_size(choice, offer);
  ImGui::Separator();
  draw_detail(choice, offer);
  ImGui::Separator();
  check("Close openings", choice.repairs);
  if (offer.parts > 1) {
    check("A piece for each part", choice.keeps_parts);
    ImGui::SameLine();
    ImGui::TextDisabled("%s", grouped(static_cast<std::int64_t>(offer.parts)).c_str());
  }
  ImGui::PopItemWidth();
}

/// Asked before the fields are drawn, which are done with it then: while one is being typed in,
/// Enter only ends that.
bool is_entered() {
  return !ImGui::IsAnyItemActive() &&
         ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false);
}

void draw_answers(UiState& ui, const MeshOffer* offer, bool enters, DocumentThread& document) {
  const std::string fault = offer != nullptr ? obstacle(ui.import, *offer) : "";
  if (!fault.empty()) colored_text(shown_colors().error, fault);
  const bool is_ready = offer != nullptr && fault.empty();
  ImGui::BeginDisabled(!is_ready);
  const bool wants = button("Import##mesh") || (is_ready && enters);
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (button("Cancel##import")) ui.panels.is_import_open = false;
  if (wants) import_as_chosen(ui, document);
}

}  // namespace

void draw_import(UiState& ui, DocumentThread& document) {
  if (!ui.panels.is_import_open) document.stop_looking();
  const MeshOffer* offer = ui.clay.offer.get();
  if (offer != nullptr && offer->number != ui.import.number) offer = nullptr;
  // What could not be read was complained of.
  if (offer != nullptr && offer->file.empty()) ui.panels.is_import_open = false;
  const DialogLayout layout{false, 600.0F, 0.0F};
  const bool is_asked = open_dialog(ui) == Dialog::import_mesh;
  if (!begin_dialog("Import", is_asked, &ui.panels.is_import_open, layout)) return;
  const bool enters = is_entered();
  if (offer == nullptr) {
    ImGui::TextUnformatted(("Reading " + ui.import.file.filename().string() + "...").c_str());
  } else {
    if (!ui.import.is_filled) fill(ui.import, *offer);
    ImGui::BeginTable("import", 2);
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch);
    ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, kPictureSide * unit());
    ImGui::TableNextColumn();
    draw_choices(ui.import, *offer);
    ImGui::TableNextColumn();
    draw_picture(ui.import, *offer);
    ImGui::EndTable();
  }
  draw_answers(ui, offer, enters, document);
  end_dialog();
}

}  // namespace argil::viewer
