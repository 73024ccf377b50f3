// SPDX-License-Identifier: GPL-3.0-or-later
// What is done to the list of pieces, kind by kind: first all that may fail, then the list.
#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>

#include "argil/engine/clay_copy.h"
#include "argil/engine/import.h"

#include "field/bad_input.h"
#include "sculpture/sculpture_state.h"

namespace argil {
namespace {

/// How many bytes the letter that begins with this one has; 0 where none can.
std::size_t letter_bytes(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return 2;
  if (first >= 0xE0 && first < 0xF0) return 3;
  return first >= 0xF0 && first < 0xF5 ? 4 : 0;
}

bool is_printable_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const auto first = static_cast<unsigned char>(text[at]);
    const std::size_t bytes = letter_bytes(first);
    if (bytes == 0 || at + bytes > text.size() || first < 0x20 || first == 0x7F) return false;
    for (std::size_t n = 1; n < bytes; ++n) {
      if ((static_cast<unsigned char>(text[at + n]) & 0xC0) != 0x80) return false;
    }
    // Written too long, half of a pair, or beyond the last letter there is.
    const auto second = static_cast<unsigned char>(bytes > 1 ? text[at + 1] : '\0');
    if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second >= 0xA0) ||
        (first == 0xF0 && second < 0x90) || (first == 0xF4 && second >= 0x90)) {
      return false;
    }
    at += bytes;
  }
  return true;
}

std::string quoted_piece(std::string_view name) { return "'" + std::string(name) + "'"; }

bool is_sound_placement(const Placement& placement) {
  const Quat& q = placement.orientation;
  const double square = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
  return is_in_reach(placement.position_mm) && std::isfinite(square) && square > 0.0;
}

Placement normalized(const Placement& placement) {
  return {placement.position_mm, normalized(placement.orientation)};
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
  Result<void> operator()(const MergePiece& merge);

 private:
  Result<std::size_t> index_of(const std::string& name) const;
  Result<std::size_t> unlocked(const std::string& name) const;
  Result<void> check_new(const PieceLook& look) const;
  Result<Clay> clay_of(const AddPiece& add) const;
  Result<void> insert(PieceLook look, Clay clay, std::size_t index);
  void take_out(std::size_t index, SculptureStep& step);

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
  look.placement = normalized(look.placement);
  Piece piece = state_.make(std::move(look), std::move(clay));
  const PieceId before = std::exchange(state_.active, piece.id);
  state_.pieces.insert(state_.pieces.begin() + static_cast<std::ptrdiff_t>(index),
                       std::move(piece));
  state_.push({{PieceMove{index, std::nullopt}}, before});
  return {};
}

/// Another piece becomes active where this one was.
void Editor::take_out(std::size_t index, SculptureStep& step) {
  assert(state_.pieces.size() > 1);
  const auto at = state_.pieces.begin() + static_cast<std::ptrdiff_t>(index);
  const bool was_active = at->id == state_.active;
  step.parts.emplace_back(PieceMove{index, std::move(*at)});
  state_.pieces.erase(at);
  step.goes_on = state_.pieces[std::min(index, state_.pieces.size() - 1)].id;
  if (was_active) state_.active = step.goes_on;
}

Result<void> Editor::operator()(const SelectPiece& select) {
  const auto index = index_of(select.name);
  if (!index) return index.error();
  state_.active = state_.pieces[index.value()].id;
  return {};
}

Result<Clay> Editor::clay_of(const AddPiece& add) const {
  if (add.clay != nullptr) return copy_of(*add.clay);
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
  return insert(std::move(look), copy_of(*piece.clay), index.value() + 1);
}

Result<void> Editor::operator()(const RemovePiece& remove) {
  const auto index = unlocked(remove.name);
  if (!index) return index.error();
  if (state_.pieces.size() == 1) {
    return bad_input("the piece " + quoted_piece(remove.name) +
                     " is the last one; a sculpture has at least one");
  }
  SculptureStep step;
  take_out(index.value(), step);
  state_.push(std::move(step));
  return {};
}

/// Of a locked piece only the lock, and whether it is seen.
Result<void> Editor::operator()(const ChangePiece& change) {
  const auto index = index_of(change.name);
  if (!index) return index.error();
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
  look.placement = normalized(look.placement);
  std::swap(piece.look, look);
  state_.push({{OtherLook{piece.id, std::move(look)}}, piece.id});
  return {};
}

Result<void> Editor::operator()(const MergePiece& merge) {
  const auto index = unlocked(merge.name);
  const auto other_index = merge.keeps_other ? index_of(merge.other) : unlocked(merge.other);
  if (!index) return index.error();
  if (!other_index) return other_index.error();
  if (index.value() == other_index.value()) {
    return bad_input("a piece cannot be merged with itself; name two pieces");
  }
  Piece& piece = state_.pieces[index.value()];
  const Piece& other = state_.pieces[other_index.value()];
  const Combine combine{merge.kind, other.clay, nullptr,
                        seen_from(piece.look.placement, other.look.placement)};
  auto combined = piece.clay->apply(Operation(combine), progress_);
  if (!combined) return combined.error();
  piece.known_steps = steps_of(*piece.clay);
  SculptureStep step;
  step.parts.emplace_back(ClayStep{piece.id});
  const PieceId merged = piece.id;
  const bool was_active = other.id == state_.active;
  if (!merge.keeps_other) {
    take_out(other_index.value(), step);
    // What was merged into is what goes on.
    if (was_active) state_.active = merged;
  }
  step.goes_on = merged;
  state_.push(std::move(step));
  return {};
}

}  // namespace

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
  state_->follow();
  return std::visit(Editor(*state_, progress), edit);
}

}  // namespace argil
