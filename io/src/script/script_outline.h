// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/engine/mask_outline.h"

#include "format/json_fields.h"
#include "format/piece_look.h"

namespace argil::io {

// A mask by an outline as a line of a script (docs/files.md).

/// Whether a line is one: edits of the whole mask have the same key.
bool is_mask_outline(const Json& json);

/// Errors  bad_input naming line and key.
Result<MaskOutline> read_mask_outline(const FileLine& where, const Json& json);

OrderedJson mask_outline_json(const MaskOutline& outline);

}  // namespace argil::io
