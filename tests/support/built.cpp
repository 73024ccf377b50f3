// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/built.h"

namespace argil::test {

const char* source_folder() { return ARGIL_SOURCE_DIR; }
const char* argil_program() { return ARGIL_BINARY; }
const char* session_child_program() { return ARGIL_SESSION_CHILD; }
const char* faulty_disk_library() { return ARGIL_FAULTY_DISK; }

}  // namespace argil::test
