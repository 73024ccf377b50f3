// SPDX-License-Identifier: GPL-3.0-or-later
#include "operations/method.h"

#include <cassert>

namespace argil::evaluation {

const char* task_name(Task task) {
  switch (task) {
    case Task::import:
      return "import";
    case Task::outward:
      return "offset +2";
    case Task::inward:
      return "offset -2";
    case Task::deep_inward:
      return "offset -8";
    case Task::unite:
      return "union";
    case Task::resample:
      return "resample";
    case Task::hollow:
      break;
  }
  return "hollow";
}

double offset_mm(Task task) {
  assert(task == Task::outward || task == Task::inward || task == Task::deep_inward);
  if (task == Task::outward) return kNearMm;
  return task == Task::inward ? -kNearMm : -kDeepMm;
}

Truth truth_of(Task task, const WorkedBody& body) {
  switch (task) {
    case Task::outward:
    case Task::inward:
    case Task::deep_inward:
      return moved_surface(body, offset_mm(task));
    case Task::unite:
      return united(body, copy_placement(body));
    case Task::hollow:
      return hollow_wall(body, kWallMm);
    case Task::import:
    case Task::resample:
      break;
  }
  return as_it_was(body);
}

}  // namespace argil::evaluation
