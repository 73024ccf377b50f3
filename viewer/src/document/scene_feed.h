// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "argil/engine/sculpture.h"

#include "document/block_news.h"

namespace argil::viewer {

/// What changed in the blocks of all pieces since a renderer last took them.
struct SceneNews {
  std::vector<PieceKey> gone;  ///< drop all blocks of these first
  std::map<PieceKey, BlockNews> pieces;

  bool empty() const noexcept { return gone.empty() && pieces.empty(); }
  /// Adds what happened after.
  void append(SceneNews&& later);
};

/// Where a ray meets the first of the visible pieces.
struct ScenePick {
  std::size_t piece = 0;  ///< of the sculpture's list
  Pick pick;              ///< in the sculpture's frame
};

/// Follows the clays of a sculpture, each in its own frame: moving a piece is no news. Pieces that
/// are hidden are followed again once they are shown.
///
/// Threads  the document thread.
class SceneFeed {
 public:
  /// From where a clay is looked at, in the sculpture's frame; nothing: all of it is shown.
  using ViewOf = std::function<std::optional<DisplayView>(const Clay&)>;

  /// What changed since the last call. `looks_at_all` false: only the active piece may have
  /// changed, and the view is as it was. Errors  memory: the next call starts afresh.
  Result<SceneNews> update(const Sculpture& sculpture, const ViewOf& view_of, bool looks_at_all);
  /// What a preview of a stroke on the active piece changed. Errors  memory: drop the preview.
  Result<SceneNews> update(const Sculpture& sculpture, Preview& preview);

  /// Of the piece that strokes go to.
  BlockFeed& active(const Sculpture& sculpture) { return follow(sculpture.clay()).feed; }
  /// The number of piece `n`, by its clay: the same for as long as the piece is there, and again
  /// when undo or redo brings it back, so that what was measured on it is found there. It may be
  /// asked before the next update knows of the piece.
  PieceKey key_of(const Sculpture& sculpture, std::size_t n);
  PieceKey active_key(const Sculpture& sculpture) { return key_of(sculpture, sculpture.active()); }

  /// The mask may differ anywhere, of any piece.
  void touch_masks() noexcept;
  /// Everything is sent again.
  void restart() noexcept;
  /// There is no sculpture any more.
  SceneNews drop_all();

  /// Where a ray meets what is seen of the pieces, as of the last update.
  std::optional<ScenePick> pick(const Sculpture& sculpture, const Ray& ray);

 private:
  struct Followed {
    PieceKey key = 0;
    std::string name;  ///< as of the last look at all
    BlockFeed feed;
  };
  struct Former {
    PieceKey key = 0;
    std::string name;
  };
  Followed& follow(const Clay& clay);
  void forget_gone(const Sculpture& sculpture);
  void take_back_key(const Clay& clay, const std::string& name);

  /// Clays stay where they are for as long as a piece can be undone or repeated.
  std::map<const Clay*, Followed> followed_;
  /// Pieces that went. The name too, since another clay may lie there once no step holds the
  /// former.
  std::map<const Clay*, Former> former_;
  std::vector<PieceKey> gone_;  ///< not told yet, also where what was to tell of them failed
  PieceKey next_key_ = 0;
  bool is_fresh_ = true;
};

}  // namespace argil::viewer
