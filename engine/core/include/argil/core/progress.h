// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string_view>

namespace argil {

/// Told now and then how far long work has come, and with what; `fraction` runs from 0 to 1 over
/// all of it, or, where stages cannot be weighed against one another, anew with each `stage`.
/// Returning false asks the work to stop: it then returns ErrorKind::interrupted and changes
/// nothing. Called on the thread that started the work. An empty function means: do not report.
using Progress = std::function<bool(std::string_view stage, double fraction)>;

}  // namespace argil
