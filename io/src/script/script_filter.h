// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/engine/mask_filter.h"

#include "format/json_fields.h"
#include "format/piece_look.h"

namespace argil::io {

// An edit of the mask that looks at the surface as a line of a script (docs/files.md).

/// Whether a line is one: edits of the whole mask have the same key.
bool is_mask_filter(const Json& json);

/// Errors  bad_input naming line and key.
Result<MaskFilter> read_mask_filter(const FileLine& where, const Json& json);

OrderedJson mask_filter_json(const MaskFilter& filter);

}  // namespace argil::io
