// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <utility>

#include <benchmark/benchmark.h>

#include "argil/core/hash.h"
#include "argil/core/result.h"
#include "argil/core/triangle_mesh.h"
#include "argil/engine/clay.h"

namespace argil::bench {

/// How much a row works on: `full` where its time counts, `brief` where run.sh --check asks only
/// whether it runs and repeats its bits.
inline double amount(double brief, double full) {
  const char* asked = std::getenv("ARGIL_BENCH_BRIEF");  // NOLINT(concurrency-mt-unsafe): read only
  return asked == nullptr ? full : brief;
}

/// A row whose hash changes between machines or commits no longer computes the same thing.
inline std::uint64_t hash_of(const TriangleMesh& mesh) noexcept {
  Hash64 hash;
  hash.update(std::as_bytes(std::span(mesh.positions)));
  hash.update(std::as_bytes(std::span(mesh.triangles)));
  return hash.digest();
}

/// Shows what the row worked on and the hash of its result; fails the row when two of its
/// iterations disagree.
class RowResult {
 public:
  explicit RowResult(benchmark::State& state) : state_(state) {}

  void add(std::uint64_t hash) {
    if (seen_ && hash != hash_) state_.SkipWithError("two iterations gave different bits");
    hash_ = hash;
    seen_ = true;
  }
  void show(const std::string& size) const {
    char digits[17];
    std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash_));
    state_.SetLabel(size + "|" + digits);
  }

 private:
  benchmark::State& state_;
  std::uint64_t hash_ = 0;
  bool seen_ = false;
};

/// The value, or ends the row with the error's message and gives nothing.
template <class T>
T* value_or_fail(benchmark::State& state, Result<T>& result) {
  if (result) return &result.value();
  state.SkipWithError(result.error().message.c_str());
  return nullptr;
}

/// A ball of 40 mm radius that a row edits, finest voxel 0.25 mm; briefly 0.5 mm.
inline Result<Clay> ball_to_edit() {
  ClayOptions options;
  options.voxel_mm = amount(0.5, options.voxel_mm);
  return Clay::ball(40.0, options);
}

/// One dab on top of that ball; `radius_mm` from 1 to 16.
inline Stroke dab_on_top(double radius_mm, Action action) {
  Stroke stroke;
  stroke.tool.action = action;
  stroke.tool.radii_mm = {radius_mm, radius_mm, radius_mm};
  stroke.samples.resize(1);
  stroke.samples[0].position_mm = {0.0, 0.0, 40.0};
  return stroke;
}

}  // namespace argil::bench
