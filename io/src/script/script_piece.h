// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/engine/sculpture.h"

#include "format/json_fields.h"
#include "script/script_operation.h"
#include "script/step_solid.h"

namespace argil::io {

// What is done to the pieces of a sculpture as a line of a script (docs/files.md).

/// Errors  bad_input naming line and key; disk, memory of what a piece is made of.
Result<PieceEdit> read_piece_edit(const FileLine& where, const Json& json, SolidReader& solids);

/// `solid` names what a new piece is made of.
OrderedJson piece_edit_json(const PieceEdit& edit, const SolidName& solid);

/// Success, or bad_input for what no line can hold: a look out of its range, a new piece without
/// just one clay or mesh.
Result<void> validate_piece_edit(const PieceEdit& edit);

}  // namespace argil::io
