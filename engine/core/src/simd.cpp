// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/core/simd.h"

#include <cstdlib>
#include <string_view>

namespace argil {
namespace {

Simd allowed_simd() noexcept {
  const char* name = std::getenv("ARGIL_SIMD");  // NOLINT(concurrency-mt-unsafe): nobody sets it
  const std::string_view most = name != nullptr ? name : "";
  if (most == "baseline") return Simd::baseline;
  return most == "avx2" ? Simd::avx2 : Simd::avx512;
}

}  // namespace

bool has_simd(Simd simd) noexcept {
#if defined(__x86_64__)
  if (simd == Simd::avx512) {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
  }
  if (simd == Simd::avx2) return __builtin_cpu_supports("avx2");
#endif
  return simd == Simd::baseline;
}

Simd best_simd() noexcept {
  static const Simd best = [] {
    const Simd most = allowed_simd();
    if (most == Simd::avx512 && has_simd(Simd::avx512)) return Simd::avx512;
    return most != Simd::baseline && has_simd(Simd::avx2) ? Simd::avx2 : Simd::baseline;
  }();
  return best;
}

}  // namespace argil
