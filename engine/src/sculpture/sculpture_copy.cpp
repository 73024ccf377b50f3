// SPDX-License-Identifier: GPL-3.0-or-later
// A copy for the disk while sculpting goes on: clay by clay, each as ClayCopy does it.
#include <cassert>
#include <utility>

#include "argil/engine/clay_copy.h"

#include "sculpture/sculpture_state.h"

namespace argil {

struct SculptureCopy::State {
  struct Copied {
    PieceId id = 0;
    ClayCopy clay;
  };
  std::vector<Copied> pieces;
  std::vector<PieceLook> looks;  ///< of them, once complete
  std::size_t active = 0;
  bool is_complete = false;

  void begin(const Sculpture::State& of) {
    pieces.clear();
    for (const Piece& piece : of.pieces) pieces.push_back({piece.id, ClayCopy(*piece.clay)});
  }
  bool has_the_pieces_of(const Sculpture::State& of) const {
    if (pieces.size() != of.pieces.size()) return false;
    for (std::size_t n = 0; n < pieces.size(); ++n) {
      if (pieces[n].id != of.pieces[n].id) return false;
    }
    return true;
  }
};

SculptureCopy::SculptureCopy(const Sculpture& sculpture) : state_(std::make_unique<State>()) {
  state_->begin(*sculpture.state_);
}
SculptureCopy::~SculptureCopy() = default;
SculptureCopy::SculptureCopy(SculptureCopy&&) noexcept = default;
SculptureCopy& SculptureCopy::operator=(SculptureCopy&&) noexcept = default;

bool SculptureCopy::advance(const Sculpture& sculpture, std::size_t most_leaves) {
  const Sculpture::State& of = *sculpture.state_;
  if (!state_->has_the_pieces_of(of)) state_->begin(of);
  // One that was complete may have changed since: each is asked every time. Only one still needs
  // leaves in a call, so that a call copies about `most_leaves`.
  for (std::size_t n = 0; n < state_->pieces.size(); ++n) {
    if (!state_->pieces[n].clay.advance(*of.pieces[n].clay, most_leaves)) return false;
  }
  state_->looks.clear();
  for (const Piece& piece : of.pieces) state_->looks.push_back(piece.look);
  state_->active = of.index_of(of.active);
  return state_->is_complete = true;
}

Sculpture SculptureCopy::take() && {
  assert(state_->is_complete);
  std::vector<Sculpture::ReadyPiece> ready;
  for (std::size_t n = 0; n < state_->pieces.size(); ++n) {
    ready.push_back({std::move(state_->looks[n]), std::move(state_->pieces[n].clay).take()});
  }
  return std::move(Sculpture::of(std::move(ready), state_->active)).value();
}

Sculpture copy_of(const Sculpture& sculpture) {
  SculptureCopy copy(sculpture);
  while (!copy.advance(sculpture, SculptureCopy::kAllLeaves)) {
  }
  return std::move(copy).take();
}

}  // namespace argil
