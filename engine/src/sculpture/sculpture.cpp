// SPDX-License-Identifier: GPL-3.0-or-later
// Pieces and what was done to them, in one order. Each clay remembers its own steps; here stands
// only whose turn it was.
#include "argil/engine/sculpture.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <new>
#include <span>
#include <type_traits>
#include <utility>

#include "argil/core/free_name.h"
#include "argil/core/hash.h"

#include "sculpture/sculpture_state.h"

namespace argil {
namespace {

template <class T>
void hash_in(Hash64& hash, const T& value) {
  static_assert(std::is_arithmetic_v<T>);
  hash.update(std::as_bytes(std::span(&value, 1)));
}

void hash_in(Hash64& hash, const Vec3& v) {
  hash_in(hash, v.x);
  hash_in(hash, v.y);
  hash_in(hash, v.z);
}

void hash_in(Hash64& hash, const PieceLook& look) {
  hash_in(hash, static_cast<std::uint64_t>(look.name.size()));
  hash.update(std::as_bytes(std::span(look.name)));
  hash_in(hash, look.placement.position_mm);
  const Quat& q = look.placement.orientation;
  hash_in(hash, q.w);
  hash_in(hash, Vec3{q.x, q.y, q.z});
  hash_in(hash, look.is_visible);
  hash_in(hash, look.is_locked);
  hash_in(hash, look.color.has_value());
  if (look.color) hash.update(std::as_bytes(std::span(*look.color)));
}

bool stays_put(const Placement& placement) {
  return placement.position_mm == Vec3{} && placement.orientation == Quat{};
}

std::int64_t bytes_of_piece(const Clay& clay) {
  const ClayUse use = clay.use();
  return use.level_bytes + use.undo_bytes + use.mask_bytes;
}

}  // namespace

std::int64_t steps_of(const Clay& clay) { return clay.undo_depth() + clay.use().steps_forgotten; }

// ---- the list ----------------------------------------------------------------------------------

std::optional<std::size_t> Sculpture::State::find(std::string_view name) const {
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    if (pieces[n].look.name == name) return n;
  }
  return std::nullopt;
}

std::size_t Sculpture::State::index_of(PieceId id) const {
  const auto at = std::find_if(pieces.begin(), pieces.end(),
                               [id](const Piece& piece) { return piece.id == id; });
  assert(at != pieces.end());
  return static_cast<std::size_t>(at - pieces.begin());
}

Piece Sculpture::State::make(PieceLook look, Clay clay) {
  const std::int64_t steps = steps_of(clay);
  return {next_id++, std::move(look), std::make_shared<Clay>(std::move(clay)), steps};
}

Sculpture::Sculpture(Clay clay, PieceLook look) : state_(std::make_unique<State>()) {
  assert(validate_look(look));
  look.placement = settled(look.placement);
  state_->limits = clay.limits();
  Piece piece = state_->make(std::move(look), std::move(clay));
  // Those that it can take back are its own.
  piece.known_steps = piece.clay->use().steps_forgotten;
  state_->pieces.push_back(std::move(piece));
}

Sculpture::Sculpture(std::unique_ptr<State> state) : state_(std::move(state)) {}
Sculpture::Sculpture(Sculpture&&) noexcept = default;
Sculpture& Sculpture::operator=(Sculpture&&) noexcept = default;
Sculpture::~Sculpture() = default;

std::size_t Sculpture::piece_count() const noexcept { return state_->pieces.size(); }
const PieceLook& Sculpture::look(std::size_t n) const {
  assert(n < piece_count());
  return state_->pieces[n].look;
}
const Clay& Sculpture::clay(std::size_t n) const {
  assert(n < piece_count());
  return *state_->pieces[n].clay;
}
std::optional<std::size_t> Sculpture::find(std::string_view name) const {
  return state_->find(name);
}
std::size_t Sculpture::active() const noexcept { return state_->index_of(state_->active); }
Clay& Sculpture::clay() noexcept { return *state_->active_piece().clay; }
const Clay& Sculpture::clay() const noexcept { return *state_->active_piece().clay; }
Clay Sculpture::take_clay() && { return std::move(*state_->active_piece().clay); }

std::string Sculpture::free_name(std::string_view base) const {
  return argil::free_name(base, kMostBytesOfAName,
                          [this](const std::string& name) { return find(name).has_value(); });
}

Result<void> Sculpture::set_limits(const ClayLimits& limits) {
  for (Piece& piece : state_->pieces) {
    if (auto set = piece.clay->set_limits(limits); !set) return set;
  }
  state_->limits = limits;
  state_->forget_what_is_too_much();
  return {};
}

bool Sculpture::is_plain() const {
  if (piece_count() > 1) return false;
  const PieceLook& only = look(0);
  return stays_put(only.placement) && only.is_visible && !only.is_locked && !only.color &&
         only.name == PieceLook().name;
}

std::uint64_t Sculpture::hash() const {
  if (is_plain()) return clay().hash();
  Hash64 hash;
  hash_in(hash, static_cast<std::uint64_t>(piece_count()));
  hash_in(hash, static_cast<std::uint64_t>(active()));
  for (const Piece& piece : state_->pieces) {
    hash_in(hash, piece.look);
    hash_in(hash, piece.clay->hash());
  }
  return hash.digest();
}

// ---- what was done -----------------------------------------------------------------------------

void Sculpture::State::follow() {
  const std::int64_t steps = steps_of(*active_piece().clay);
  assert(steps >= active_piece().known_steps);
  while (active_piece().known_steps < steps) {
    make_room();
    push({{ClayStep{active}}});
    ++active_piece().known_steps;
  }
}

void Sculpture::State::make_room() {
  const auto room_for_one = [](auto& list) {
    if (list.size() == list.capacity()) list.reserve(2 * list.size() + 8);
  };
  room_for_one(pieces);
  room_for_one(undo_steps);
  room_for_one(redo_steps);
}

void Sculpture::State::push(SculptureStep step) noexcept {
  assert(undo_steps.size() < undo_steps.capacity());
  undo_steps.push_back(std::move(step));
  drop(redo_steps, redo_steps.size());
  forget_what_is_too_much();
}

void Sculpture::State::take_out(PieceMove& move) noexcept {
  const auto at = pieces.begin() + static_cast<std::ptrdiff_t>(move.index);
  move.held_bytes = bytes_of_piece(*at->clay);
  held_bytes += move.held_bytes;
  move.held = std::move(*at);
  pieces.erase(at);
}

void Sculpture::State::put_back(PieceMove& move) noexcept {
  assert(move.held && pieces.size() < pieces.capacity());
  pieces.insert(pieces.begin() + static_cast<std::ptrdiff_t>(move.index), *std::move(move.held));
  move.held.reset();
  held_bytes -= std::exchange(move.held_bytes, 0);
}

/// The first so many of some steps, with the pieces that they hold.
void Sculpture::State::drop(std::vector<SculptureStep>& steps, std::size_t oldest) noexcept {
  for (std::size_t n = 0; n < oldest; ++n) {
    for (const auto& part : steps[n].parts) {
      if (const auto* move = std::get_if<PieceMove>(&part)) held_bytes -= move->held_bytes;
    }
  }
  steps.erase(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(oldest));
}

/// What lies farthest goes until what steps hold of removed pieces fits; the last step stays. Those
/// that no clay remembers go now and then.
void Sculpture::State::forget_what_is_too_much() noexcept {
  while (held_bytes > limits.undo_bytes && undo_steps.size() + redo_steps.size() > 1) {
    const bool is_redo = undo_steps.size() < 2 && !redo_steps.empty();
    drop(is_redo ? redo_steps : undo_steps, 1);
  }
  if (undo_steps.size() <= steps_to_look_at) return;
  try {
    drop(undo_steps, undo_steps.size() - reachable_steps());
  } catch (const std::bad_alloc&) {
    // Next time: they do no harm.
  }
  steps_to_look_at = 2 * undo_steps.size() + 64;
}

std::size_t Sculpture::State::reachable_steps() const {
  // Ids count from 0: of each clay, those of removed pieces included, how many it has left.
  std::vector<int> left(next_id, 0);
  for (const Piece& piece : pieces) left[piece.id] = piece.clay->undo_depth();
  if (held_bytes > 0) {
    for (const SculptureStep& step : undo_steps) {
      for (const auto& part : step.parts) {
        const auto* move = std::get_if<PieceMove>(&part);
        if (move != nullptr && move->held) left[move->held->id] = move->held->clay->undo_depth();
      }
    }
  }
  std::size_t count = 0;
  for (auto step = undo_steps.rbegin(); step != undo_steps.rend(); ++step) {
    for (const auto& part : step->parts) {
      const auto* own = std::get_if<ClayStep>(&part);
      if (own != nullptr && left[own->piece]-- == 0) return count;
    }
    ++count;
  }
  return count;
}

bool Sculpture::State::turn(SculptureStep& step, bool is_undo) {
  // Of the parts only a clay's own step can fail, and no step has more than one: it comes first.
  for (const auto& part : step.parts) {
    const auto* own = std::get_if<ClayStep>(&part);
    if (own == nullptr) continue;
    Piece& piece = of(own->piece);
    if (!(is_undo ? piece.clay->undo() : piece.clay->redo())) return false;
    piece.known_steps = steps_of(*piece.clay);
  }
  const auto turn_part = [&](auto& part) {
    if (auto* other = std::get_if<OtherLook>(&part)) std::swap(of(other->piece).look, other->look);
    auto* move = std::get_if<PieceMove>(&part);
    if (move != nullptr) move->held ? put_back(*move) : take_out(*move);
  };
  if (is_undo) {
    std::for_each(step.parts.rbegin(), step.parts.rend(), turn_part);
  } else {
    std::for_each(step.parts.begin(), step.parts.end(), turn_part);
  }
  if (const auto& now = is_undo ? step.before : step.after) active = *now;
  return true;
}

bool Sculpture::State::turn_last(bool is_undo) {
  if (is_stroke_open()) return false;
  follow();
  make_room();
  std::vector<SculptureStep>& from = is_undo ? undo_steps : redo_steps;
  if (from.empty()) return false;
  // A step may bring several pieces back.
  pieces.reserve(pieces.size() + from.back().parts.size());
  if (!turn(from.back(), is_undo)) return false;
  (is_undo ? redo_steps : undo_steps).push_back(std::move(from.back()));
  from.pop_back();
  return true;
}

bool Sculpture::undo() { return state_->turn_last(true); }
bool Sculpture::redo() { return state_->turn_last(false); }

int Sculpture::undo_depth() {
  state_->follow();
  return static_cast<int>(state_->reachable_steps());
}

int Sculpture::redo_depth() {
  state_->follow();
  return static_cast<int>(state_->redo_steps.size());
}

}  // namespace argil
