// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "shell/app_description.h"

namespace argil::cli {

// Scripts that complete command lines of `program`: sourced by hand, or put where the shell looks
// (bash-completion/completions/argil, zsh/site-functions/_argil).
std::string bash_completion(const DescribedCommand& program);
std::string zsh_completion(const DescribedCommand& program);

}  // namespace argil::cli
