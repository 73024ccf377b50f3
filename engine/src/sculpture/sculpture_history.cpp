// SPDX-License-Identifier: GPL-3.0-or-later
// The history of a sculpture as a whole: taken over from the same sculpture made anew, or given up.
#include <cassert>
#include <utility>

#include "clay/clay_access.h"
#include "sculpture/sculpture_state.h"

namespace argil {

/// A step knows a piece by its number and a clay by its bits, so both go along.
void Sculpture::take_history(Sculpture&& other) {
  State& own = *state_;
  State& from = *other.state_;
  assert(!own.is_stroke_open() && !from.is_stroke_open());
  assert(piece_count() == other.piece_count() && active() == other.active());
  from.follow();  // takes memory: before anything changes
  for (std::size_t n = 0; n < own.pieces.size(); ++n) {
    assert(own.pieces[n].look.name == from.pieces[n].look.name);
    ClayAccess::swap_histories(*own.pieces[n].clay, *from.pieces[n].clay);
    own.pieces[n].id = from.pieces[n].id;
    own.pieces[n].known_steps = from.pieces[n].known_steps;
  }
  own.active = from.active;
  own.next_id = from.next_id;
  own.undo_steps = std::move(from.undo_steps);
  own.redo_steps = std::move(from.redo_steps);
  own.held_bytes = from.held_bytes;
  own.steps_to_look_at = from.steps_to_look_at;
}

void Sculpture::forget_history() {
  State& own = *state_;
  assert(!own.is_stroke_open());
  for (Piece& piece : own.pieces) {
    ClayAccess::forget_history(*piece.clay);
    piece.known_steps = steps_of(*piece.clay);
  }
  own.undo_steps.clear();
  own.redo_steps.clear();
  own.held_bytes = 0;
}

}  // namespace argil
