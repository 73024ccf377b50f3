// SPDX-License-Identifier: GPL-3.0-or-later
// Comparisons of eight values in a row, as bits: what marks, masks and sides of nodes are made of.
// Written with SSE2, which every x86-64 has, since compilers make no movmskps of a loop.
#pragma once

#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#else
#include <array>
#include <cmath>
#include <cstddef>
#endif

namespace argil {

#if defined(__SSE2__)

namespace row_bits {
inline unsigned of(__m128 low, __m128 high) noexcept {
  return static_cast<unsigned>(_mm_movemask_ps(low)) | static_cast<unsigned>(_mm_movemask_ps(high))
                                                           << 4;
}
}  // namespace row_bits

/// Which of eight values are negative, that is, inside; -0 is not.
inline unsigned inside_bits(const float* row) noexcept {
  const __m128 zero = _mm_setzero_ps();
  return row_bits::of(_mm_cmplt_ps(_mm_loadu_ps(row), zero),
                      _mm_cmplt_ps(_mm_loadu_ps(row + 4), zero));
}

/// Which of eight values are nearer to 0 than `band`.
inline unsigned band_bits(const float* row, float band) noexcept {
  const __m128 most = _mm_set1_ps(band);
  const __m128 sign = _mm_set1_ps(-0.0F);
  return row_bits::of(_mm_cmplt_ps(_mm_andnot_ps(sign, _mm_loadu_ps(row)), most),
                      _mm_cmplt_ps(_mm_andnot_ps(sign, _mm_loadu_ps(row + 4)), most));
}

/// Which of eight values differ from others; 0 and -0 are one value.
inline unsigned changed_bits(const float* from, const float* to) noexcept {
  return row_bits::of(_mm_cmpneq_ps(_mm_loadu_ps(from), _mm_loadu_ps(to)),
                      _mm_cmpneq_ps(_mm_loadu_ps(from + 4), _mm_loadu_ps(to + 4)));
}

/// Which of eight values are farther from others than `allowed`.
inline unsigned far_bits(const float* values, const float* others, float allowed) noexcept {
  const __m128 most = _mm_set1_ps(allowed);
  const __m128 sign = _mm_set1_ps(-0.0F);
  const auto apart = [&](int n) {
    return _mm_andnot_ps(sign, _mm_sub_ps(_mm_loadu_ps(values + n), _mm_loadu_ps(others + n)));
  };
  return row_bits::of(_mm_cmpgt_ps(apart(0), most), _mm_cmpgt_ps(apart(4), most));
}

#else

namespace row_bits {
template <class IsSo>
unsigned where(const IsSo& is_so) noexcept {
  constexpr std::array<unsigned, 8> kBit{1, 2, 4, 8, 16, 32, 64, 128};
  unsigned bits = 0;
  for (std::size_t n = 0; n < 8; ++n) bits |= is_so(n) ? kBit[n] : 0U;
  return bits;
}
}  // namespace row_bits

inline unsigned inside_bits(const float* row) noexcept {
  return row_bits::where([&](std::size_t n) { return row[n] < 0.0F; });
}
inline unsigned band_bits(const float* row, float band) noexcept {
  return row_bits::where([&](std::size_t n) { return std::abs(row[n]) < band; });
}
inline unsigned changed_bits(const float* from, const float* to) noexcept {
  return row_bits::where([&](std::size_t n) { return from[n] != to[n]; });
}
inline unsigned far_bits(const float* values, const float* others, float allowed) noexcept {
  return row_bits::where([&](std::size_t n) { return std::abs(values[n] - others[n]) > allowed; });
}

#endif

/// band_bits of eight rows: a word of a leaf's active mask.
inline std::uint64_t bits_of_band(const float* plane, float band) noexcept {
  std::uint64_t bits = 0;
  for (unsigned row = 0; row < 8; ++row) {
    bits |= std::uint64_t{band_bits(plane + 8 * row, band)} << (8 * row);
  }
  return bits;
}

}  // namespace argil
