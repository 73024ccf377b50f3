// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include <sys/types.h>

namespace argil::test {

/// Starts a program with these arguments and the environment of this one, in which these variables
/// ("NAME=value") take the place of those of their names; its process. Files that are open here are
/// open there. A test whose process has threads must not fork and go on: the child has their locks,
/// and an allocator's may be held.
pid_t spawn(const std::string& program, const std::vector<std::string>& arguments,
            const std::vector<std::string>& variables = {});

}  // namespace argil::test
