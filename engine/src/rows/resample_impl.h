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

/// Of a row, at all places.
ARGIL_ROWS void curve_row(const float* from, const CurveJob& job, float* out) {
  const int count = job.count;
  for (int done = 0; done < count; done += kRowNodes) {
    float lanes[4][kRowNodes];
    float along[kRowNodes];
    const int lanes_used = count - done < kRowNodes ? count - done : kRowNodes;
    for (int lane = 0; lane < kRowNodes; ++lane) {
      const CurvePlace& place = job.places[done + (lane < lanes_used ? lane : 0)];
      along[lane] = place.t;
      for (int tap = 0; tap < 4; ++tap) lanes[tap][lane] = from[place.first + tap];
    }
    EightFloats node[4];
    EightFloats t;
    EightFloats value;
    for (int tap = 0; tap < 4; ++tap) load_eight(lanes[tap], node[tap]);
    load_eight(along, t);
    curve_at(node, t, job.crease, value);
    __builtin_memcpy(out + done, &value, static_cast<unsigned>(lanes_used) * sizeof(float));
  }
}

void curve_along(const CurveJob& job, float* out) noexcept {
  for (int n = 0; n < job.outer; ++n) {
    const float* from = job.from + n * job.nodes * job.inner;
    if (job.inner == 1) {
      curve_row(from, job, out);
      out += job.count;
      continue;
    }
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
