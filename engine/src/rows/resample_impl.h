// SPDX-License-Identifier: GPL-3.0-or-later
// The loop of resample(). Included by rows_impl.h after layer_impl.h.

/// Of two second differences the first, no farther from 0 than that of a crease and a multiple of
/// the second.
template <class Values>
ARGIL_ROWS void steady(const Values& of, const Values& beside, float crease, Values& out) {
  // Beyond a crease the curve of one side would ring; elsewhere neighbours are not as unlike.
  constexpr float kMost = 8.0F;
  Values most = kMost * (beside < 0.0F ? -beside : beside);
  most = most < crease ? Values{} + crease : most;
  out = of < -most ? -most : of;
  out = most < out ? most : out;
}

/// The curve of Catmull and Rom is the chord less what the second differences at its ends bend it.
template <class Values>
ARGIL_ROWS void curve_at(const Values (&node)[4], const Values& t, float crease, Values& out) {
  const Values at_first = node[0] - 2.0F * node[1] + node[2];
  const Values at_second = node[1] - 2.0F * node[2] + node[3];
  Values first;
  Values second;
  steady(at_first, at_second, crease, first);
  steady(at_second, at_first, crease, second);
  const Values rest = 1.0F - t;
  out = node[1] + t * (node[2] - node[1]) - (0.5F * t * rest) * (rest * first + t * second);
}

/// Of `inner` numbers beside each other, all at one place.
ARGIL_ROWS void curve_across(const float* from, int inner, float t, float crease, float* out) {
  int done = 0;
  while (done + kRowNodes <= inner) {
    EightFloats node[4];
    for (int tap = 0; tap < 4; ++tap) load_eight(from + tap * inner + done, node[tap]);
    EightFloats value;
    curve_at(node, EightFloats{} + t, crease, value);
    __builtin_memcpy(out + done, &value, sizeof value);
    done += kRowNodes;
    // The last vector may overlap the one before it.
    if (done < inner && done + kRowNodes > inner) done = inner - kRowNodes;
  }
  for (; done < inner; ++done) {
    const float node[4] = {from[done], from[inner + done], from[2 * inner + done],
                           from[3 * inner + done]};
    curve_at(node, t, crease, out[done]);
  }
}

/// Eight places along a row.
struct EightPlaces {
  int base;         ///< the first node of the row that they read
  int span;         ///< how many they read from there on
  EightInts first;  ///< of each its first tap, from there on
  EightFloats t;
};

/// The places from `done` on; lanes for which none is left have the first of them.
ARGIL_ROWS void eight_places(const CurveJob& job, int done, EightPlaces& out) {
  int first[kRowNodes];
  float t[kRowNodes];
  int low = job.places[done].first;
  int high = low;
  for (int lane = 0; lane < kRowNodes; ++lane) {
    const CurvePlace& place = job.places[done + lane < job.count ? done + lane : done];
    low = place.first < low ? place.first : low;
    high = place.first > high ? place.first : high;
    first[lane] = place.first;
    t[lane] = place.t;
  }
  out.base = low;
  out.span = high + 4 - low;
  __builtin_memcpy(&out.first, first, sizeof first);
  out.first -= low;
  load_eight(t, out.t);
}

/// The nodes that the places read, tap by tap. `is_whole`: eight nodes from their base on are
/// there, and they read no others.
ARGIL_ROWS void taps_of(const float* row, const EightPlaces& places, bool is_whole,
                        EightFloats* node) {
  const float* from = row + places.base;
#if defined(__AVX2__)
  if (is_whole) {
    EightFloats all;
    load_eight(from, all);
    for (int tap = 0; tap < 4; ++tap) {
      node[tap] = __builtin_ia32_permvarsf256(all, places.first + tap);
    }
    return;
  }
#else
  (void)is_whole;
#endif
  for (int tap = 0; tap < 4; ++tap) {
    float lanes[kRowNodes];
    for (int lane = 0; lane < kRowNodes; ++lane) lanes[lane] = from[places.first[lane] + tap];
    load_eight(lanes, node[tap]);
  }
}

/// Of rows, all at the same places.
ARGIL_ROWS void curve_rows(const CurveJob& job, float* out) {
  for (int done = 0; done < job.count; done += kRowNodes) {
    EightPlaces places;
    eight_places(job, done, places);
    const int used = job.count - done < kRowNodes ? job.count - done : kRowNodes;
    for (int n = 0; n < job.outer; ++n) {
      const int left = (job.outer - n) * job.nodes - places.base;
      EightFloats node[4];
      EightFloats value;
      taps_of(job.from + n * job.nodes, places, places.span <= kRowNodes && left >= kRowNodes,
              node);
      curve_at(node, places.t, job.crease, value);
      float* const to = out + n * job.count + done;
      if (used == kRowNodes) {
        __builtin_memcpy(to, &value, sizeof value);
      } else {
        __builtin_memcpy(to, &value, static_cast<unsigned>(used) * sizeof(float));
      }
    }
  }
}

void curve_along(const CurveJob& job, float* out) noexcept {
  if (job.inner == 1) return curve_rows(job, out);
  for (int n = 0; n < job.outer; ++n) {
    const float* from = job.from + n * job.nodes * job.inner;
    for (int at = 0; at < job.count; ++at) {
      const CurvePlace& place = job.places[at];
      const float* first = from + place.first * job.inner;
      if (place.t == 0.0F) {
        __builtin_memcpy(out, first + job.inner, static_cast<unsigned>(job.inner) * sizeof(float));
      } else {
        curve_across(first, job.inner, place.t, job.crease, out);
      }
      out += job.inner;
    }
  }
}
