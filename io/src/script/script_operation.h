// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "argil/engine/operation.h"

#include "format/json_fields.h"
#include "format/piece_look.h"
#include "script/step_solid.h"

namespace argil::io {

// An operation on the whole clay as a line of a script (docs/files.md).

/// Errors  bad_input naming line and key; disk, memory of the other solid.
Result<Operation> read_operation(const FileLine& where, const Json& json, SolidReader& solids);

/// The file that a step's line names, and the hash it must have when there is one.
/// Errors  bad_input naming line and key.
Result<SolidName> read_solid_name(const Fields& fields, const char* key, const char* hash_key);

/// `error` of reading what `key` names, with its line; the kind stays.
Error solid_error(const FileLine& where, const char* key, const Error& error);

/// `solid` names the other solid of a combination.
OrderedJson operation_json(const Operation& operation, const SolidName& solid);

/// Success, or bad_input for what no line can hold: a number that is not finite, a combination
/// without just one other solid. Ranges that depend on the clay are its own to judge.
Result<void> validate_operation(const Operation& operation);

}  // namespace argil::io
