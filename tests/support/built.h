// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil::test {

// Absolute paths that only the build knows. Only one small source has them compiled in, so that a
// compiler cache has all others for every clone.

const char* source_folder();
const char* argil_program();          ///< of the command line
const char* session_child_program();  ///< sculpts until it is killed
const char* faulty_disk_library();    ///< to be loaded before others

}  // namespace argil::test
