// SPDX-License-Identifier: GPL-3.0-or-later
#include "stability/late/late_case.h"

#include <cassert>

namespace argil::evaluation {

haptics::ForceMaterial material_of(const LateTool& tool) {
  assert(!tool.is_spring() && tool.skin_mm > 0.0);
  haptics::ForceMaterial material;
  material.skin_mm = tool.skin_mm;
  material.exponent = tool.exponent;
  return material;
}

const char* late_action_name(LateAction action) {
  switch (action) {
    case LateAction::touch:
      return "touch";
    case LateAction::slide:
      return "slide";
    case LateAction::carve:
      return "carve";
    case LateAction::add:
      return "add";
    case LateAction::smooth:
      break;
  }
  return "smooth";
}

const char* late_remedy_name(LateRemedy remedy) {
  switch (remedy) {
    case LateRemedy::at_once:
      return "at_once";
    case LateRemedy::blended:
      return "blended";
    case LateRemedy::account:
      return "account";
    case LateRemedy::stamped:
      return "stamped";
    case LateRemedy::governed:
      return "governed";
    case LateRemedy::reaching:
      break;
  }
  return "reaching";
}

}  // namespace argil::evaluation
