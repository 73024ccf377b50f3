// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil {

/// Instruction sets that inner loops are compiled for. All give the same bits: the same operations
/// in the same order, and nothing contracted.
enum class Simd { baseline, avx2, avx512 };

/// Whether this machine has it.
///
/// Threads      any; realtime.
bool has_simd(Simd simd) noexcept;

/// The fastest that this machine has, and not a faster one than the environment's ARGIL_SIMD names
/// ("baseline" or "avx2"; any other text limits nothing): so that results can be compared.
///
/// Threads      any; realtime but for the first call, which reads the environment.
Simd best_simd() noexcept;

}  // namespace argil
