// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "argil/engine/sculpture.h"

namespace argil {

/// Told apart by a number, since names change.
using PieceId = std::uint32_t;

struct Piece {
  PieceId id = 0;
  PieceLook look;
  std::shared_ptr<Clay> clay;  ///< never null; shared only while a combination reads it
  /// Steps of the clay that the sculpture knows of: those that can be undone or were forgotten.
  std::int64_t known_steps = 0;
};

// What an undo step of a sculpture is made of; all but the first are turned by swapping.

/// A step of a piece's clay, which remembers it itself.
struct ClayStep {
  PieceId piece = 0;
};
/// The other look of a piece.
struct OtherLook {
  PieceId piece = 0;
  PieceLook look;
};
/// A piece that comes or goes, with its place in the list.
struct PieceMove {
  std::size_t index = 0;
  std::optional<Piece> held = std::nullopt;  ///< the piece, while it is not in the list
  std::int64_t held_bytes = 0;               ///< of it
};

struct SculptureStep {
  std::vector<std::variant<ClayStep, OtherLook, PieceMove>> parts;  ///< in the order they were done
  /// Which piece is active on either side of a step that a piece comes or goes with.
  std::optional<PieceId> before = std::nullopt;
  std::optional<PieceId> after = std::nullopt;
};

struct Sculpture::State {
  std::vector<Piece> pieces;
  PieceId active = 0;
  PieceId next_id = 0;
  ClayLimits limits;
  std::vector<SculptureStep> undo_steps;
  std::vector<SculptureStep> redo_steps;
  std::int64_t held_bytes = 0;        ///< of pieces that steps hold
  std::size_t steps_to_look_at = 64;  ///< when there are so many, those that are of no use go

  std::optional<std::size_t> find(std::string_view name) const;
  std::size_t index_of(PieceId id) const;
  Piece& of(PieceId id) { return pieces[index_of(id)]; }
  const Piece& of(PieceId id) const { return pieces[index_of(id)]; }
  Piece& active_piece() { return of(active); }
  const Piece& active_piece() const { return of(active); }
  Piece make(PieceLook look, Clay clay);

  /// Takes note of the steps that the active clay made by itself.
  void follow();
  /// Room for one piece and one step more. What takes memory is done here, before anything changes:
  /// the next three cannot fail then. References to pieces end here.
  void make_room();
  /// A new step; what could be repeated no longer can.
  void push(SculptureStep step) noexcept;
  void take_out(PieceMove& move) noexcept;
  void put_back(PieceMove& move) noexcept;
  void drop(std::vector<SculptureStep>& steps, std::size_t oldest) noexcept;
  void forget_what_is_too_much() noexcept;
  /// How many of the steps can be taken back: a clay may have forgotten its oldest.
  std::size_t reachable_steps() const;
  bool is_stroke_open() const { return active_piece().clay->is_stroke_open(); }

  /// Does a step the other way round; false, and nothing done, where a clay has forgotten it.
  bool turn(SculptureStep& step, bool is_undo);
  /// The same with the step that comes next, which goes to the other side then.
  bool turn_last(bool is_undo);
};

/// A placement as pieces have it: a quaternion of unit length, no negative zeros. Once more changes
/// no bit.
Placement settled(const Placement& placement);

/// Of a clay: all steps it ever made but for those taken back.
std::int64_t steps_of(const Clay& clay);

}  // namespace argil
