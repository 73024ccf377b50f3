// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "argil/core/result.h"
#include "argil/engine/sculpture.h"

#include "format/json_fields.h"

namespace argil::io {

using OrderedJson = nlohmann::ordered_json;  // what is written keeps the order a person reads it in

/// The keys `position_mm` and `orientation`; what is absent leaves its part of `out` alone.
/// Errors  bad_input naming line and key.
Result<void> read_placement(const Fields& fields, Placement& out);
void put_placement(OrderedJson& json, const Placement& placement);

/// Those, `visible`, `locked` and `color`, where they are not as usual; the name has a key of its
/// own.
void put_look(OrderedJson& json, const PieceLook& look);
/// What put_look puts; absent keys leave their part of `out` alone.
/// Errors  bad_input naming line and key.
Result<void> read_look(const Fields& fields, PieceLook& out);

/// "#rrggbb".
std::string color_text(const Rgb8& color);

}  // namespace argil::io
