// SPDX-License-Identifier: GPL-3.0-or-later
// Sixteen floats at once, two blocks of eight nodes, out of as many registers as the instruction
// set needs. Every set does the same operations on the same lanes in the same order (and nothing is
// contracted), so all give the same bits. Included by lattice_sums_impl.h and
// scene/sine_network_impl.h inside the namespace of the set; kRegister bytes are defined there.

constexpr int kLanes = 16;
constexpr int kParts = kLanes * 4 / kRegister;
constexpr int kPartLanes = kRegister / 4;

typedef float FloatPart __attribute__((vector_size(kRegister)));
typedef int IntPart __attribute__((vector_size(kRegister)));

struct Lanes {
  FloatPart part[kParts];
};
struct IntLanes {
  IntPart part[kParts];
};

#define ARGIL_LANES static inline __attribute__((always_inline))

ARGIL_LANES Lanes spread(float a) {
  Lanes r;
  for (int n = 0; n < kParts; ++n) r.part[n] = a - FloatPart{};
  return r;
}
ARGIL_LANES Lanes operator+(const Lanes& a, const Lanes& b) {
  Lanes r;
  for (int n = 0; n < kParts; ++n) r.part[n] = a.part[n] + b.part[n];
  return r;
}
ARGIL_LANES Lanes operator-(const Lanes& a, const Lanes& b) {
  Lanes r;
  for (int n = 0; n < kParts; ++n) r.part[n] = a.part[n] - b.part[n];
  return r;
}
ARGIL_LANES Lanes operator*(const Lanes& a, const Lanes& b) {
  Lanes r;
  for (int n = 0; n < kParts; ++n) r.part[n] = a.part[n] * b.part[n];
  return r;
}
ARGIL_LANES Lanes operator/(const Lanes& a, const Lanes& b) {
  Lanes r;
  for (int n = 0; n < kParts; ++n) r.part[n] = a.part[n] / b.part[n];
  return r;
}
ARGIL_LANES void operator+=(Lanes& a, const Lanes& b) {
  for (int n = 0; n < kParts; ++n) a.part[n] += b.part[n];
}
ARGIL_LANES Lanes greater_of(const Lanes& a, const Lanes& b) {
  Lanes r;
  for (int n = 0; n < kParts; ++n) r.part[n] = a.part[n] > b.part[n] ? a.part[n] : b.part[n];
  return r;
}
ARGIL_LANES Lanes lesser_of(const Lanes& a, const Lanes& b) {
  Lanes r;
  for (int n = 0; n < kParts; ++n) r.part[n] = a.part[n] < b.part[n] ? a.part[n] : b.part[n];
  return r;
}
/// a where `test` is positive, else 0.
ARGIL_LANES Lanes where_positive(const Lanes& test, const Lanes& a) {
  Lanes r;
  for (int n = 0; n < kParts; ++n) r.part[n] = test.part[n] > 0.0F ? a.part[n] : FloatPart{};
  return r;
}
ARGIL_LANES IntLanes truncated(const Lanes& a) {
  IntLanes r;
  for (int n = 0; n < kParts; ++n) r.part[n] = __builtin_convertvector(a.part[n], IntPart);
  return r;
}
ARGIL_LANES Lanes as_floats(const IntLanes& a) {
  Lanes r;
  for (int n = 0; n < kParts; ++n) r.part[n] = __builtin_convertvector(a.part[n], FloatPart);
  return r;
}
ARGIL_LANES Lanes square_root(const Lanes& a) {
  Lanes r;
  for (int n = 0; n < kParts; ++n) {
    for (int lane = 0; lane < kPartLanes; ++lane) {
      r.part[n][lane] = __builtin_sqrtf(a.part[n][lane]);
    }
  }
  return r;
}
/// Eight floats from each of two addresses.
ARGIL_LANES Lanes load_pair(const float* first, const float* second) {
  Lanes r;
#if defined(__AVX512F__)
  r.part[0] = _mm512_insertf32x8(_mm512_castps256_ps512(_mm256_loadu_ps(first)),
                                 _mm256_loadu_ps(second), 1);
#else
  __builtin_memcpy(&r.part[0], first, sizeof r / 2);
  __builtin_memcpy(&r.part[kParts / 2], second, sizeof r / 2);
#endif
  return r;
}
/// One float in the first eight lanes, one in the others.
ARGIL_LANES Lanes spread_pair(float first, float second) {
  Lanes r;
#if defined(__AVX512F__)
  r.part[0] = _mm512_mask_broadcastss_ps(_mm512_set1_ps(first), 0xFF00, _mm_set_ss(second));
#else
  for (int n = 0; n < kParts; ++n) r.part[n] = (n < kParts / 2 ? first : second) - FloatPart{};
#endif
  return r;
}

/// table[at], for 0 <= at < kLawSegments.
ARGIL_LANES Lanes look_up(const float* table, const IntLanes& at) {
  Lanes r;
#if defined(__AVX512F__)
  static_assert(kParts == 1 && kLawSegments == 2 * kLanes);
  r.part[0] = _mm512_permutex2var_ps(_mm512_loadu_ps(table), reinterpret_cast<__m512i>(at.part[0]),
                                     _mm512_loadu_ps(table + kLanes));
#else
  for (int n = 0; n < kParts; ++n) {
    for (int lane = 0; lane < kPartLanes; ++lane) r.part[n][lane] = table[at.part[n][lane]];
  }
#endif
  return r;
}

/// The sum over the even, or the odd, lanes.
ARGIL_LANES double sum_of(const Lanes& a, int first, int step) {
  double sum = 0.0;
  for (int lane = first; lane < kLanes; lane += step) {
    sum += static_cast<double>(a.part[lane / kPartLanes][lane % kPartLanes]);
  }
  return sum;
}
