// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <span>

#include "edit/level_edit.h"

namespace argil {

/// What is to be solved of one leaf of an edit.
struct SweptLeaf {
  LeafEdit* leaf = nullptr;
  NodeRows dirty{};  ///< these nodes, but for those that the finer level decides
  NodeRows anew{};   ///< of those next to a sign change, these are measured again
};

/// Solves |grad phi| = 1 for the dirty nodes of an edit, each keeping its sign, outward from those
/// next to a sign change and from all other nodes, which stay. A node next to a sign change is
/// measured by value / |gradient| where the field is smooth and else by the cuts of its lattice
/// edges, if it is in `anew` or off by more than a factor 2; else it keeps its value. Each leaf may
/// be given once.
///
/// Accuracy     that of fast_march(), which solves the same equations: within 0.01 voxel of it
///              (DistanceSweeps.AgreeWithTheMarch). After 32 sweeps what still moves stays as it
///              is.
/// Determinism  every sweep reads the one before, so that neither order nor threads can show; the
///              same bits with every instruction set.
/// Cost         2.5 us a leaf and sweep, 6 without AVX2, as far as its rows do not rest; seven to
///              twelve sweeps are usual.
/// Source       Jacobi sweeps over the upwind equations, as E. Rouy, A. Tourin, "A viscosity
///              solutions approach to shape-from-shading", SIAM J. Numer. Anal. 29 (1992).
/// `goes_on`, if given, is asked before each sweep; false, and nothing written, when it said no.
bool sweep_distances(LevelEdit& edit, std::span<const SweptLeaf> leaves,
                     const std::function<bool()>& goes_on = {});

}  // namespace argil
