// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "arena/solids.h"
#include "arena/surgery.h"
#include "arena/truth.h"

namespace argil::arena {

/// One of the 25 kinds of fault.
struct Fault {
  const char* kind;
  int strengths;  ///< 1 to this, each worse than the one before
  /// Breaks a sound solid. None where the solid is not one that can be broken so.
  std::optional<Broken> (*make)(const Solid& solid, int strength, Random& random);
};

/// All of them, in the order in which docs/testing.md explains them.
std::span<const Fault> faults();

/// The sound solid with itself as the truth: what faults begin with.
Broken sound(const Solid& solid);

// Faults that leave the truth what it was, so that several can follow one another. They change
// `broken.mesh`, and what its truth may have or leaves open.

/// `count` patches of at least `radius` (of the largest side) go.
void add_holes(Broken& broken, std::size_t count, double radius, Random& random);
/// A share of all triangles goes, one at least.
void drop_faces(Broken& broken, double share, Random& random);
/// A share of all triangles is turned over.
void flip_faces(Broken& broken, double share, Random& random);
/// Triangles stand on so many edges.
void add_fins(Broken& broken, std::size_t count, Random& random);
/// A share of all triangles is given twice, every third of them three times.
void repeat_faces(Broken& broken, double share, Random& random);
/// A share of all triangles has a vertex on an edge that its neighbour has not, `off` (of the
/// largest side) beside it.
void add_t_joints(Broken& broken, double share, double off, Random& random);
/// Every triangle has three corners of its own, each moved by up to `size` (of the largest side).
void unweld(Broken& broken, double size, Random& random);

// The kinds, by the file that they are in.

// faults_holes.cpp
std::optional<Broken> holes(const Solid& solid, int strength, Random& random);
std::optional<Broken> missing_faces(const Solid& solid, int strength, Random& random);
std::optional<Broken> cut_off(const Solid& solid, int strength, Random& random);
std::optional<Broken> cracks(const Solid& solid, int strength, Random& random);
std::optional<Broken> overlapping_patches(const Solid& solid, int strength, Random& random);
std::optional<Broken> thin_sheets(const Solid& solid, int strength, Random& random);

// faults_faces.cpp
std::optional<Broken> flipped_faces(const Solid& solid, int strength, Random& random);
std::optional<Broken> flipped_patches(const Solid& solid, int strength, Random& random);
std::optional<Broken> inside_out(const Solid& solid, int strength, Random& random);
std::optional<Broken> fans(const Solid& solid, int strength, Random& random);
std::optional<Broken> duplicate_shells(const Solid& solid, int strength, Random& random);
std::optional<Broken> duplicate_faces(const Solid& solid, int strength, Random& random);
std::optional<Broken> loose_sheets(const Solid& solid, int strength, Random& random);

// faults_points.cpp
std::optional<Broken> folds(const Solid& solid, int strength, Random& random);
std::optional<Broken> noise(const Solid& solid, int strength, Random& random);
std::optional<Broken> jitter(const Solid& solid, int strength, Random& random);
std::optional<Broken> slivers(const Solid& solid, int strength, Random& random);
std::optional<Broken> t_joints(const Solid& solid, int strength, Random& random);
std::optional<Broken> mixed(const Solid& solid, int strength, Random& random);

// faults_solids.cpp
std::optional<Broken> inner_walls(const Solid& solid, int strength, Random& random);
std::optional<Broken> common_faces(const Solid& solid, int strength, Random& random);
std::optional<Broken> touching_parts(const Solid& solid, int strength, Random& random);
std::optional<Broken> crossing_parts(const Solid& solid, int strength, Random& random);
std::optional<Broken> self_crossing(const Solid& solid, int strength, Random& random);
std::optional<Broken> nested_parts(const Solid& solid, int strength, Random& random);

}  // namespace argil::arena
