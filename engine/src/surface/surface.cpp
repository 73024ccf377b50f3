// SPDX-License-Identifier: GPL-3.0-or-later
// A Surface remembers of which clay, and of which revision, its blocks are; anything else is
// extracted again in full.
#include "argil/engine/surface.h"

#include <utility>

#include "clay/clay_access.h"
#include "surface/block_surface.h"

namespace argil {

struct Surface::State {
  BlockSurface blocks;
  std::uint64_t identity = 0;  // of the clay the blocks are of
  std::uint64_t revision = 0;  // of it, when they were brought up to date
  bool empty = true;
};

Surface::Surface() : state_(std::make_unique<State>()) {}
Surface::Surface(Surface&&) noexcept = default;
Surface& Surface::operator=(Surface&&) noexcept = default;
Surface::~Surface() = default;

std::int64_t Surface::update(const Clay& clay) {
  State& s = *state_;
  std::optional<std::vector<LeafChange>> changes;
  if (!s.empty && s.identity == identity(clay)) changes = changes_since(clay, s.revision);
  s.empty = true;  // should the extraction fail, the next one starts over
  const std::int64_t extracted =
      changes ? s.blocks.update(levels_of(clay), *changes) : s.blocks.rebuild_all(levels_of(clay));
  s.identity = identity(clay);
  s.revision = revision(clay);
  s.empty = false;
  return extracted;
}

std::int64_t Surface::triangle_count() const noexcept { return state_->blocks.triangle_count(); }

TriangleMesh Surface::weld() const { return state_->blocks.weld(); }

TriangleMesh extract_surface(const Clay& clay) {
  Surface surface;
  surface.update(clay);
  return surface.weld();
}

Result<TriangleMesh> extract_surface(const Clay& clay, const Progress& progress) {
  const Error interrupted{ErrorKind::interrupted, "interrupted; no surface was extracted"};
  BlockSurface blocks;
  if (!blocks.rebuild_all(levels_of(clay), progress)) return interrupted;
  auto mesh = blocks.weld(progress);
  if (!mesh) return interrupted;
  return *std::move(mesh);
}

}  // namespace argil
