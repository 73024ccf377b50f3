// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "argil/core/progress.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"
#include "argil/engine/operation.h"

namespace argil {

/// Red, green and blue in sRGB.
using Rgb8 = std::array<std::uint8_t, 3>;

/// How a piece is called, where it stands and how it is shown. What is sculpted stays in the
/// piece's own frame, in mm: moving a piece changes no bit of its clay.
struct PieceLook {
  /// 1 to kMostBytesOfAName bytes of UTF-8 without control characters, nor blanks at its ends;
  /// differs from piece to piece.
  std::string name = "Clay";
  Placement placement = {};  ///< of the piece's frame in the sculpture
  bool is_visible = true;
  bool is_locked = false;  ///< strokes and operations on it are refused
  std::optional<Rgb8> color = std::nullopt;
};

// What can be done to the pieces of a sculpture: Sculpture::apply. Each but SelectPiece is one undo
// step. Pieces are named by PieceLook::name.

/// Strokes and operations go to this piece from now on.
struct SelectPiece {
  std::string name;
};

/// Another piece, which is then the active one. One of `clay` and `mesh` is given.
struct AddPiece {
  PieceLook look = {};
  std::shared_ptr<const Clay> clay = nullptr;          ///< copied
  std::shared_ptr<const TriangleMesh> mesh = nullptr;  ///< as import_mesh takes it
  /// Of a mesh; 0: that of the active piece, whose tolerance and radius of edges it gets.
  double voxel_mm = 0.0;
};

/// The same clay once more, at the same place: then the active piece.
struct CopyPiece {
  std::string name;
  std::string copy;  ///< the new piece's name
};

/// The last piece cannot be removed.
struct RemovePiece {
  std::string name;
};

/// What is given is changed.
struct ChangePiece {
  std::string name;
  std::optional<std::string> new_name = std::nullopt;
  std::optional<Placement> placement = std::nullopt;
  std::optional<bool> is_visible = std::nullopt;
  std::optional<bool> is_locked = std::nullopt;
  std::optional<std::optional<Rgb8>> color = std::nullopt;  ///< given and none: without a colour
};

/// Combines a piece with another, both where they stand, and removes the other unless it is kept.
/// The accuracy is that of Combine.
struct MergePiece {
  std::string name;
  std::string other;
  CombineKind kind = CombineKind::unite;
  bool keeps_other = false;
};

/// Several pieces get these places at once, or none does. At least one; no piece twice.
struct PlacePieces {
  struct Place {
    std::string name;
    Placement placement = {};
  };
  std::vector<Place> places;
};

/// A piece becomes larger or smaller, its clay with it: its voxel times `factor`, its values too,
/// so that it keeps its detail and mask, and takes as much memory. A tool of so many mm stays one;
/// Resample gives the former voxel again.
struct ScalePiece {
  std::string name;
  /// Above 0, not 1. As large as leaves the voxel within kLeastVoxelMm to kMostVoxelMm, and all of
  /// the clay within 1 km of its origin.
  double factor = 1.0;
  /// What stays where it is, in the sculpture; none: the origin of the piece's frame, which is its
  /// place.
  std::optional<Vec3> about_mm = std::nullopt;
};

/// A piece that is several solids apart becomes as many pieces: the largest keeps name, place in
/// the list and history, the others stand behind it, the largest first, by its name with a number,
/// and with its look. A cavity belongs to the solid that it is in; a solid in a cavity is one of
/// its own. Far from the others, the clay of each keeps its bits; near them it is the distance to
/// its own surface, as if the others had never been there.
struct SplitPiece {
  std::string name;
  /// What has less of the volume of the largest than this stays with it, so that crumbs make no
  /// pieces; 0 to 1, and 0 splits off everything.
  double crumb_share = 0.001;
};

using PieceEdit = std::variant<SelectPiece, AddPiece, CopyPiece, RemovePiece, ChangePiece,
                               PlacePieces, ScalePiece, SplitPiece, MergePiece>;

/// A point of a piece's frame in the sculpture, and back.
Vec3 placed(const Placement& placement, const Vec3& point_mm) noexcept;
Vec3 unplaced(const Placement& placement, const Vec3& point_mm) noexcept;

/// Success, or bad_input naming what of it no piece can have, with the remedy.
Result<void> validate_look(const PieceLook& look);

/// Several clays that are one work: each piece with a clay, a name and a place of its own. One is
/// active: what is done to clay() goes to it, and undo takes back whatever was done last to any.
///
/// Threads  as Clay; all pieces belong to one thread.
/// Errors   a failed call leaves everything as it was.
class Sculpture {
 public:
  static constexpr std::size_t kMostPieces = 1000;
  static constexpr std::size_t kMostBytesOfAName = 63;

  /// One piece.
  explicit Sculpture(Clay clay, PieceLook look = {});

  /// Pieces that lie ready, as a file has them. Errors  bad_input: none, too many, names or looks
  /// that no piece can have, or no piece `active`.
  struct ReadyPiece {
    PieceLook look;
    Clay clay;
  };
  static Result<Sculpture> of(std::vector<ReadyPiece> pieces, std::size_t active);

  Sculpture(Sculpture&&) noexcept;
  Sculpture& operator=(Sculpture&&) noexcept;
  ~Sculpture();

  std::size_t piece_count() const noexcept;
  /// In the order in which they are listed; `n` below piece_count() (assert).
  const PieceLook& look(std::size_t n) const;
  const Clay& clay(std::size_t n) const;
  std::optional<std::size_t> find(std::string_view name) const;
  std::size_t active() const noexcept;

  /// The active piece's. It may be changed by everything but its own undo and redo; they would
  /// leave out what was done to other pieces since.
  Clay& clay() noexcept;
  const Clay& clay() const noexcept;
  /// The active piece's, out of the sculpture, which is of no further use.
  Clay take_clay() &&;
  /// Success, or bad_input: the active piece is locked.
  Result<void> check_unlocked() const;

  /// `base`, or with the first number behind it that no piece's name has.
  std::string free_name(std::string_view base) const;

  /// Errors  bad_input: no such piece, a name that is taken, a look out of its range, the last
  ///         piece, a locked piece to be moved, scaled, split, removed or merged, one solid to be
  ///         split, or an open stroke; memory: all pieces together would take more than
  ///         ClayLimits::memory_bytes of one; interrupted; as Clay::apply (MergePiece) and
  ///         import_mesh (AddPiece).
  /// Determinism  same bits for any number of threads (SculptureGolden.*).
  /// Cost    AddPiece of a clay, CopyPiece and ScalePiece: a copy of its leaves. SplitPiece: its
  ///         surface and 0.3 to 1 us for each node of the leaves that several solids reach.
  ///         RemovePiece keeps the clay for undo; ClayLimits::undo_bytes bounds what is kept of
  ///         removed pieces, too.
  Result<void> apply(const PieceEdit& edit, const Progress& progress = {});

  /// Takes back, or repeats, what was done last to any piece, or to their list. False where there
  /// is nothing, or while a stroke is open. Where a piece comes or goes, the one is active that was
  /// before, or after. Throw bad_alloc as those of Clay.
  bool undo();
  bool redo();
  int undo_depth();
  /// At most: a clay may have forgotten what lies farthest.
  int redo_depth();

  /// Takes over what `other` can take back and repeat, which is the same sculpture made anew from
  /// an earlier state: equal hash() (asserts: as many pieces of the same names), no open stroke of
  /// either (assert). The own history is forgotten; clays and their surfaces stay as they are.
  /// Throws bad_alloc with nothing changed. Cost  none that grows with the clay.
  void take_history(Sculpture&& other);
  /// From here nothing can be taken back or repeated. No stroke is open (assert).
  void forget_history();

  /// Of each piece. Errors  as Clay::set_limits.
  Result<void> set_limits(const ClayLimits& limits);

  /// Whether it is no more than its clay: a single piece that stands where it was made, visible,
  /// free, without a colour, by its usual name.
  bool is_plain() const;

  /// Of all pieces with their looks and clays, and of which is active. Of a plain sculpture the
  /// hash of its clay.
  std::uint64_t hash() const;

  struct State;  // private to the engine

 private:
  friend class SculptureCopy;
  explicit Sculpture(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

/// A mesh of the piece's frame in the sculpture, in place.
void place(const Placement& placement, TriangleMesh& mesh);

/// The surfaces of all visible pieces where they stand, one behind the other; pieces that overlap
/// stay as they are. Errors  interrupted.
Result<TriangleMesh> extract_surface(const Sculpture& sculpture, const Progress& progress = {});

/// A copy of a sculpture made in pieces between strokes, as ClayCopy is of a clay. The copy has no
/// history.
class SculptureCopy {
 public:
  static constexpr std::size_t kAllLeaves = std::numeric_limits<std::size_t>::max();

  explicit SculptureCopy(const Sculpture& sculpture);
  ~SculptureCopy();
  SculptureCopy(SculptureCopy&&) noexcept;
  SculptureCopy& operator=(SculptureCopy&&) noexcept;

  /// As ClayCopy::advance. `sculpture` is that of the constructor.
  bool advance(const Sculpture& sculpture, std::size_t most_leaves);
  /// Once complete.
  Sculpture take() &&;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The sculpture as it stands, with nothing to undo.
Sculpture copy_of(const Sculpture& sculpture);

}  // namespace argil
