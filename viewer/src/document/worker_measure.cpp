// SPDX-License-Identifier: GPL-3.0-or-later
// What the document thread measures.
#include "document/document_worker.h"
#include "document/measure_pick.h"

namespace argil::viewer {

MeasureAnswer DocumentWorker::measure(const MeasureQuestion& question) {
  MeasureAnswer answer;
  answer.number = question.number;
  answer.far_enough_mm = question.far_enough_mm;
  if (!document_.has_project()) return answer;
  const Sculpture& sculpture = document_.sculpture();
  for (std::size_t n = 0; question.kept && n < sculpture.piece_count(); ++n) {
    if (feed_.key_of(sculpture, n) != question.kept->piece) continue;
    answer.is_kept = is_still_there(sculpture.clay(n), *question.kept);
  }
  const auto picked = measure_pick(sculpture, question.ray, question.seen);
  if (!picked) return answer;
  const Clay& clay = sculpture.clay(picked->piece);
  answer.point = MeasurePoint{feed_.key_of(sculpture, picked->piece), picked->own_mm,
                              picked->own_normal, picked->is_on_slice};
  answer.distance_mm = picked->distance_mm;
  answer.is_on_slice = picked->is_on_slice;
  if (!question.wants_far_side || picked->is_on_slice) return answer;
  if (const auto across = far_side(clay, picked->own_mm, picked->own_normal)) {
    answer.across = MeasurePoint{answer.point->piece, *across, -1.0 * picked->own_normal};
  }
  return answer;
}

}  // namespace argil::viewer
