// SPDX-License-Identifier: GPL-3.0-or-later
// What is done to the list of pieces, kind by kind: first all that may fail, then the list.
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <memory>
#include <new>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "argil/core/free_name.h"
#include "argil/engine/clay_copy.h"
#include "argil/engine/import.h"
#include "argil/engine/surface.h"

#include "clay/clay_access.h"
#include "edit/history.h"
#include "field/bad_input.h"
#include "field/level_stack.h"
#include "operation/prepared_operation.h"
#include "operation/scaled_levels.h"
#include "operation/split_levels.h"
#include "sculpture/sculpture_state.h"

namespace argil {
namespace {

struct Letter {
  std::size_t bytes = 0;  ///< 0: no UTF-8
  char32_t code = 0;
};

/// The first letter of a text that is not empty.
Letter first_letter(std::string_view text) {
  const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(text[n]); };
  const unsigned char first = byte(0);
  const std::size_t bytes = first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if ((first >= 0x80 && first < 0xC2) || first > 0xF4 || bytes > text.size()) return {};
  char32_t code = bytes == 1 ? first : first & (0x7FU >> bytes);
  for (std::size_t n = 1; n < bytes; ++n) {
    if ((byte(n) & 0xC0) != 0x80) return {};
    code = code << 6 | (byte(n) & 0x3FU);
  }
  // Written longer than it need be, half of a pair, or beyond the last letter there is.
  constexpr std::array<char32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
  const bool is_half = code >= 0xD800 && code < 0xE000;
  if (code < kLeast[bytes] || is_half || code > 0x10FFFF) return {};
  return {bytes, code};
}

/// What has no shape of its own: controls, and marks that turn the direction of a line about.
bool is_control(char32_t code) {
  const auto is_in = [code](char32_t first, char32_t last) {
    return code >= first && code <= last;
  };
  return code < 0x20 || is_in(0x7F, 0x9F) || is_in(0x200B, 0x200F) || is_in(0x2028, 0x202E) ||
         is_in(0x2060, 0x206F) || code == 0xFEFF;
}

bool is_printable_utf8(std::string_view text) {
  while (!text.empty()) {
    const Letter letter = first_letter(text);
    if (letter.bytes == 0 || is_control(letter.code)) return false;
    text.remove_prefix(letter.bytes);
  }
  return true;
}

std::string quoted_piece(std::string_view name) { return std::string(1, '\'').append(name) + "'"; }

double largest_of(const Quat& q) {
  return std::max({std::abs(q.w), std::abs(q.x), std::abs(q.y), std::abs(q.z)});
}

bool is_sound_placement(const Placement& placement) {
  const Quat& q = placement.orientation;
  return is_in_reach(placement.position_mm) && std::isfinite(q.w) &&
         is_finite(Vec3{q.x, q.y, q.z}) && largest_of(q) > 0.0;
}

/// First b, then a.
Quat quat_product(const Quat& a, const Quat& b) {
  return {
      a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
      a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

/// Where `what` stands seen from `frame`; both of unit length.
Placement seen_from(const Placement& frame, const Placement& what) {
  if (frame.orientation == what.orientation && frame.position_mm == what.position_mm) return {};
  const Quat back = conjugate(frame.orientation);
  return {rotate(back, what.position_mm - frame.position_mm),
          normalized(quat_product(back, what.orientation))};
}

/// One edit of a sculpture; refers to its state.
class Editor {
 public:
  Editor(Sculpture::State& state, const Progress& progress) : state_(state), progress_(progress) {}

  Result<void> operator()(const SelectPiece& select);
  Result<void> operator()(const AddPiece& add);
  Result<void> operator()(const CopyPiece& copy);
  Result<void> operator()(const RemovePiece& remove);
  Result<void> operator()(const ChangePiece& change);
  Result<void> operator()(const PlacePieces& place);
  Result<void> operator()(const ScalePiece& scale);
  Result<void> operator()(const SplitPiece& split);
  Result<void> operator()(const MergePiece& merge);

 private:
  Result<std::size_t> index_of(const std::string& name) const;
  Result<std::size_t> unlocked(const std::string& name) const;
  Result<void> check_new(const PieceLook& look) const;
  Result<Clay> clay_of(const AddPiece& add) const;
  Result<void> insert(PieceLook look, Clay clay, std::size_t index);
  Result<void> check_memory(const Clay& clay) const;
  Result<void> check_memory(const ClayUse& more) const;
  Result<void> check_memory(const LevelStack& levels) const;
  Result<void> check_factor(const ScalePiece& scale, const Clay& clay) const;
  using LevelList = std::vector<std::unique_ptr<LevelStack>>;
  Result<LevelList> solids_of(const SplitPiece& split, const Clay& clay) const;
  Result<void> list_parts(std::size_t index, LevelList solids);
  PieceId next_to(std::size_t index) const;

  Sculpture::State& state_;
  const Progress& progress_;
};

Result<std::size_t> Editor::index_of(const std::string& name) const {
  if (const auto found = state_.find(name)) return *found;
  std::string names;
  for (const Piece& piece : state_.pieces) {
    names.append(names.empty() ? "" : ", ").append(quoted_piece(piece.look.name));
    if (names.size() > 200) break;
  }
  return bad_input("there is no piece " + quoted_piece(name) + "; there are " + names);
}

Result<std::size_t> Editor::unlocked(const std::string& name) const {
  auto index = index_of(name);
  if (!index || !state_.pieces[index.value()].look.is_locked) return index;
  return bad_input("the piece " + quoted_piece(name) + " is locked; unlock it first");
}

Result<void> Editor::check_new(const PieceLook& look) const {
  if (auto valid = validate_look(look); !valid) return valid;
  if (state_.find(look.name)) {
    return bad_input("there is a piece " + quoted_piece(look.name) + " already; give another name");
  }
  if (state_.pieces.size() < Sculpture::kMostPieces) return {};
  return bad_input("there are " + std::to_string(Sculpture::kMostPieces) +
                   " pieces, which is the most; merge or remove some");
}

/// At the list's place `index`, and active.
Result<void> Editor::insert(PieceLook look, Clay clay, std::size_t index) {
  if (auto set = clay.set_limits(state_.limits); !set) return set;
  look.placement = settled(look.placement);
  state_.make_room();
  Piece piece = state_.make(std::move(look), std::move(clay));
  SculptureStep step{{PieceMove{index}}, state_.active, piece.id};
  state_.active = piece.id;
  state_.pieces.insert(state_.pieces.begin() + static_cast<std::ptrdiff_t>(index),
                       std::move(piece));
  state_.push(std::move(step));
  return {};
}

/// Another clay as large as this one must fit beside those that are there, as if they were one.
Result<void> Editor::check_memory(const Clay& clay) const { return check_memory(clay.use()); }

Result<void> Editor::check_memory(const ClayUse& more) const {
  const ClayUse own = state_.active_piece().clay->use();
  const auto bytes_of = [](const ClayUse& use) {
    return use.level_bytes + use.undo_bytes + use.mask_bytes;
  };
  const std::int64_t most = own.free_bytes + bytes_of(own);
  std::int64_t taken = state_.held_bytes;
  for (const Piece& piece : state_.pieces) taken += bytes_of(piece.clay->use());
  if (taken + more.level_bytes + more.mask_bytes <= most) return {};
  return Error{
      ErrorKind::memory,
      "another " + std::to_string(more.level_bytes >> 20) +
          " MB do not fit beside the pieces that are there; remove some, or resample them"};
}

/// The same for the levels alone: the former ones stay for undo where others replace them.
Result<void> Editor::check_memory(const LevelStack& levels) const {
  ClayUse more;
  more.level_bytes = leaf_bytes(levels);
  more.mask_bytes = mask_bytes(levels);
  return check_memory(more);
}

/// Which piece goes on where one is taken out.
PieceId Editor::next_to(std::size_t index) const {
  assert(state_.pieces.size() > 1);
  return state_.pieces[index + 1 < state_.pieces.size() ? index + 1 : index - 1].id;
}

Result<void> Editor::operator()(const SelectPiece& select) {
  const auto index = index_of(select.name);
  if (!index) return index.error();
  state_.active = state_.pieces[index.value()].id;
  return {};
}

Result<Clay> Editor::clay_of(const AddPiece& add) const {
  if (add.clay != nullptr) {
    if (auto fits = check_memory(*add.clay); !fits) return fits.error();
    return copy_of(*add.clay);
  }
  ClayOptions options = state_.active_piece().clay->options();
  if (add.voxel_mm != 0.0) options.voxel_mm = add.voxel_mm;
  auto imported = import_mesh(*add.mesh, options, progress_);
  if (!imported) return imported.error();
  return std::move(imported.value().clay);
}

Result<void> Editor::operator()(const AddPiece& add) {
  if ((add.clay != nullptr) == (add.mesh != nullptr)) {
    return bad_input("a piece is made of a clay or of a mesh; give one of them");
  }
  if (auto valid = check_new(add.look); !valid) return valid;
  auto clay = clay_of(add);
  if (!clay) return clay.error();
  return insert(add.look, std::move(clay).value(), state_.pieces.size());
}

Result<void> Editor::operator()(const CopyPiece& copy) {
  const auto index = index_of(copy.name);
  if (!index) return index.error();
  const Piece& piece = state_.pieces[index.value()];
  PieceLook look = piece.look;
  look.name = copy.copy;
  look.is_locked = false;
  if (auto valid = check_new(look); !valid) return valid;
  if (auto fits = check_memory(*piece.clay); !fits) return fits;
  return insert(std::move(look), copy_of(*piece.clay), index.value() + 1);
}

Result<void> Editor::operator()(const RemovePiece& remove) {
  const auto index = unlocked(remove.name);
  if (!index) return index.error();
  if (state_.pieces.size() == 1) {
    return bad_input("the piece " + quoted_piece(remove.name) +
                     " is the last one; a sculpture has at least one");
  }
  state_.make_room();
  const PieceId active = state_.active;
  const bool is_active = state_.pieces[index.value()].id == active;
  SculptureStep step{
      {PieceMove{index.value()}}, active, is_active ? next_to(index.value()) : active};
  state_.take_out(std::get<PieceMove>(step.parts.front()));
  state_.active = *step.after;
  state_.push(std::move(step));
  return {};
}

/// Of a locked piece everything but its place.
Result<void> Editor::operator()(const ChangePiece& change) {
  const auto index = index_of(change.name);
  if (!index) return index.error();
  state_.make_room();
  Piece& piece = state_.pieces[index.value()];
  PieceLook look = piece.look;
  if (change.new_name) look.name = *change.new_name;
  if (change.placement) look.placement = *change.placement;
  if (change.is_visible) look.is_visible = *change.is_visible;
  if (change.is_locked) look.is_locked = *change.is_locked;
  if (change.color) look.color = *change.color;
  if (auto valid = validate_look(look); !valid) return valid;
  const auto same_name = state_.find(look.name);
  if (same_name && *same_name != index.value()) {
    return bad_input("there is a piece " + quoted_piece(look.name) + " already; give another name");
  }
  if (piece.look.is_locked && look.is_locked && change.placement) {
    return bad_input("the piece " + quoted_piece(change.name) + " is locked; unlock it first");
  }
  if (change.placement) look.placement = settled(look.placement);
  SculptureStep step{{OtherLook{piece.id, std::move(look)}}};
  std::swap(piece.look, std::get<OtherLook>(step.parts.front()).look);
  state_.push(std::move(step));
  return {};
}

Result<void> Editor::operator()(const PlacePieces& place) {
  if (place.places.empty()) return bad_input("no piece is named that shall be placed; name one");
  SculptureStep step;
  std::set<PieceId> named;
  for (const PlacePieces::Place& wanted : place.places) {
    const auto index = unlocked(wanted.name);
    if (!index) return index.error();
    const Piece& piece = state_.pieces[index.value()];
    if (!named.insert(piece.id).second) {
      return bad_input("the piece " + quoted_piece(wanted.name) + " is placed twice; name it once");
    }
    PieceLook look = piece.look;
    look.placement = wanted.placement;
    if (auto valid = validate_look(look); !valid) return valid;
    look.placement = settled(look.placement);
    step.parts.emplace_back(OtherLook{piece.id, std::move(look)});
  }
  state_.make_room();
  for (auto& part : step.parts) {
    OtherLook& other = std::get<OtherLook>(part);
    std::swap(state_.of(other.piece).look, other.look);
  }
  state_.push(std::move(step));
  return {};
}

Result<void> Editor::check_factor(const ScalePiece& scale, const Clay& clay) const {
  const double voxel = clay.options().voxel_mm;
  const Box3 box = clay.bounds_mm();
  double reach = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    reach = std::max({reach, std::abs(box.min[axis]), std::abs(box.max[axis])});
  }
  const double least = kLeastVoxelMm / voxel;
  const double most = std::min(kMostVoxelMm / voxel, kMaxReachMm / reach);
  if (!(scale.factor >= least && scale.factor <= most)) {
    return bad_input("the factor is " + digits(scale.factor) + "; for the piece " +
                     quoted_piece(scale.name) + " it must be from " + digits(least) + " to " +
                     digits(most));
  }
  if (scale.about_mm && !is_in_reach(*scale.about_mm)) {
    return bad_input("the piece is to be scaled about " + digits(*scale.about_mm) +
                     "; give a point within 1 km of the origin");
  }
  if (scale.factor != 1.0) return {};
  return bad_input("the factor is 1, which changes nothing; give another");
}

/// The clay's own step comes first: only that can fail later.
Result<void> Editor::operator()(const ScalePiece& scale) {
  const auto index = unlocked(scale.name);
  if (!index) return index.error();
  state_.make_room();
  Piece& piece = state_.pieces[index.value()];
  if (auto fits = check_factor(scale, *piece.clay); !fits) return fits;
  ClayOptions options = piece.clay->options();
  options.voxel_mm = std::clamp(scale.factor * options.voxel_mm, kLeastVoxelMm, kMostVoxelMm);
  PieceLook look = piece.look;
  Vec3& at = look.placement.position_mm;
  if (scale.about_mm) at = *scale.about_mm + scale.factor * (at - *scale.about_mm);
  if (auto valid = validate_look(look); !valid) return valid;
  look.placement = settled(look.placement);
  if (auto fits = check_memory(levels_of(*piece.clay)); !fits) return fits;
  SculptureStep step{{ClayStep{piece.id}}};
  const bool is_moved = !(look.placement.position_mm == piece.look.placement.position_mm);
  if (is_moved) step.parts.emplace_back(OtherLook{piece.id, std::move(look)});
  auto levels = scaled_levels(levels_of(*piece.clay), options.voxel_mm, progress_);
  if (!levels) return operation_interrupted();
  ClayAccess::replace_levels(*piece.clay, std::move(levels), options);
  piece.known_steps = steps_of(*piece.clay);
  if (is_moved) std::swap(piece.look, std::get<OtherLook>(step.parts.back()).look);
  state_.push(std::move(step));
  return {};
}

/// The levels of each solid, crumbs with those of the largest, which is the first.
Result<Editor::LevelList> Editor::solids_of(const SplitPiece& split, const Clay& clay) const {
  auto surface = extract_surface(clay, progress_);
  if (!surface) return surface.error();
  SurfaceSolids solids = argil::solids_of(surface.value());
  const std::vector<double>& volumes = solids.volume_mm3;
  const std::string named = "the piece " + quoted_piece(split.name);
  if (volumes.size() < 2) return bad_input(named + " is one solid; there is nothing to split");
  const auto is_crumb = [&](double volume) { return volume < split.crumb_share * volumes.front(); };
  const auto first_crumb = std::find_if(volumes.begin(), volumes.end(), is_crumb);
  const auto count = static_cast<std::size_t>(first_crumb - volumes.begin());
  if (count < 2) {
    return bad_input(named + " is one solid and crumbs of less than " + digits(split.crumb_share) +
                     " of its volume; give a smaller share");
  }
  if (state_.pieces.size() + count - 1 > Sculpture::kMostPieces) {
    return bad_input(named + " is " + std::to_string(count) + " solids, and there may be " +
                     std::to_string(Sculpture::kMostPieces) +
                     " pieces; give a larger share of crumbs");
  }
  // All solids together are about as large; what they are is checked when they are made.
  if (auto fits = check_memory(levels_of(clay)); !fits) return fits.error();
  for (std::uint32_t& part : solids.of_triangle) part = part < count ? part : 0;
  const ClayOptions& options = clay.options();
  return split_levels(levels_of(clay), surface.value(), solids.of_triangle, count,
                      options.tolerance_voxels * options.voxel_mm, progress_);
}

/// All but the first as pieces behind the one at `index`, whose clay becomes the first: one step.
Result<void> Editor::list_parts(std::size_t index, LevelList solids) {
  state_.pieces.reserve(state_.pieces.size() + solids.size());
  state_.make_room();
  Piece& first = state_.pieces[index];
  const ClayOptions options = first.clay->options();
  SculptureStep step{{ClayStep{first.id}}, state_.active, state_.active};
  std::vector<Piece> others;
  std::set<std::string> taken;
  for (std::size_t n = 1; n < solids.size(); ++n) {
    Clay clay = clay_of_levels(std::move(solids[n]), options);
    if (auto set = clay.set_limits(state_.limits); !set) return set;
    PieceLook look = first.look;
    look.name = free_name(first.look.name, Sculpture::kMostBytesOfAName, [&](const auto& name) {
      return taken.contains(name) || state_.find(name).has_value();
    });
    taken.insert(look.name);
    step.parts.emplace_back(PieceMove{index + n});
    others.push_back(state_.make(std::move(look), std::move(clay)));
  }
  ClayAccess::replace_levels(*first.clay, std::move(solids.front()), options);
  first.known_steps = steps_of(*first.clay);
  state_.pieces.insert(state_.pieces.begin() + static_cast<std::ptrdiff_t>(index) + 1,
                       std::make_move_iterator(others.begin()),
                       std::make_move_iterator(others.end()));
  state_.push(std::move(step));
  return {};
}

Result<void> Editor::operator()(const SplitPiece& split) {
  const auto index = unlocked(split.name);
  if (!index) return index.error();
  if (!(split.crumb_share >= 0.0 && split.crumb_share <= 1.0)) {
    return bad_input("the share of crumbs is " + digits(split.crumb_share) +
                     "; must be from 0 to 1");
  }
  auto solids = solids_of(split, *state_.pieces[index.value()].clay);
  if (!solids) return solids.error();
  // What is there now stays as well, for undo.
  ClayUse more;
  for (const std::unique_ptr<LevelStack>& levels : solids.value()) {
    more.level_bytes += leaf_bytes(*levels);
    more.mask_bytes += mask_bytes(*levels);
  }
  if (auto fits = check_memory(more); !fits) return fits;
  return list_parts(index.value(), std::move(solids).value());
}

Result<void> Editor::operator()(const MergePiece& merge) {
  const auto index = unlocked(merge.name);
  const auto other_index = merge.keeps_other ? index_of(merge.other) : unlocked(merge.other);
  if (!index) return index.error();
  if (!other_index) return other_index.error();
  if (index.value() == other_index.value()) {
    return bad_input("a piece cannot be merged with itself; name two pieces");
  }
  state_.make_room();
  Piece& piece = state_.pieces[index.value()];
  const Piece& other = state_.pieces[other_index.value()];
  SculptureStep step{{ClayStep{piece.id}}};
  if (!merge.keeps_other) {
    step.parts.emplace_back(PieceMove{other_index.value()});
    step.before = state_.active;
    // What was merged into is what goes on.
    step.after = other.id == state_.active ? piece.id : state_.active;
  }
  const Combine combine{merge.kind, other.clay, nullptr,
                        seen_from(piece.look.placement, other.look.placement)};
  auto combined = piece.clay->apply(Operation(combine), progress_);
  if (!combined) return combined.error();
  piece.known_steps = steps_of(*piece.clay);
  if (!merge.keeps_other) {
    state_.take_out(std::get<PieceMove>(step.parts.back()));
    state_.active = *step.after;
  }
  state_.push(std::move(step));
  return {};
}

}  // namespace

Placement settled(const Placement& placement) {
  Vec3 at = placement.position_mm;
  Quat q = placement.orientation;
  // First by the largest, or squares of what is tiny or huge are lost.
  const double largest = largest_of(q);
  assert(largest > 0.0);
  const double square = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  constexpr double kRounding = 1e-12;
  if (!(std::abs(square - 1.0) < kRounding)) {
    q = normalized(Quat{q.w / largest, q.x / largest, q.y / largest, q.z / largest});
  }
  // -0 + 0 is 0.
  at += Vec3{};
  return {at, {q.w + 0.0, q.x + 0.0, q.y + 0.0, q.z + 0.0}};
}

Vec3 placed(const Placement& placement, const Vec3& point_mm) noexcept {
  return rotate(placement.orientation, point_mm) + placement.position_mm;
}

Vec3 unplaced(const Placement& placement, const Vec3& point_mm) noexcept {
  return rotate(conjugate(placement.orientation), point_mm - placement.position_mm);
}

Result<void> validate_look(const PieceLook& look) {
  const std::string& name = look.name;
  const std::string must = "; must be 1 to " + std::to_string(Sculpture::kMostBytesOfAName) +
                           " bytes of text without control characters or blanks at its ends";
  if (name.empty()) return bad_input("a piece has no name" + must);
  // What is no text cannot be shown.
  if (!is_printable_utf8(name)) return bad_input("a piece's name is no plain text" + must);
  if (name.size() > Sculpture::kMostBytesOfAName || name.front() == ' ' || name.back() == ' ') {
    return bad_input("a piece's name is " + quoted_piece(name.substr(0, 200)) + must);
  }
  if (is_sound_placement(look.placement)) return {};
  return bad_input("the piece " + quoted_piece(name) +
                   " is placed where nothing can be; give a position within 1 km of the origin and "
                   "a quaternion of any length but zero");
}

Result<Sculpture> Sculpture::of(std::vector<ReadyPiece> pieces, std::size_t active) {
  if (pieces.empty() || pieces.size() > kMostPieces || active >= pieces.size()) {
    return bad_input("a sculpture has 1 to " + std::to_string(kMostPieces) +
                     " pieces, of which one is active; these are " + std::to_string(pieces.size()) +
                     ", active is number " + std::to_string(active + 1));
  }
  auto state = std::make_unique<State>();
  state->limits = pieces.front().clay.limits();
  for (ReadyPiece& piece : pieces) {
    if (auto valid = validate_look(piece.look); !valid) return valid.error();
    if (state->find(piece.look.name)) {
      return bad_input("two pieces are called " + quoted_piece(piece.look.name));
    }
    piece.look.placement = settled(piece.look.placement);
    if (auto set = piece.clay.set_limits(state->limits); !set) return set.error();
    state->pieces.push_back(state->make(std::move(piece.look), std::move(piece.clay)));
  }
  state->active = state->pieces[active].id;
  return Sculpture(std::move(state));
}

Result<void> Sculpture::check_unlocked() const {
  const PieceLook& look = state_->active_piece().look;
  if (!look.is_locked) return {};
  return bad_input("the piece " + quoted_piece(look.name) + " is locked; unlock it first");
}

Result<void> Sculpture::apply(const PieceEdit& edit, const Progress& progress) {
  if (state_->is_stroke_open()) {
    return bad_input("a stroke is open; end or cancel it before pieces change");
  }
  try {
    state_->follow();
    return std::visit(Editor(*state_, progress), edit);
  } catch (const std::bad_alloc&) {
    return Error{ErrorKind::memory,
                 "not enough memory for another piece; remove some, or close "
                 "other programs"};
  }
}

}  // namespace argil
