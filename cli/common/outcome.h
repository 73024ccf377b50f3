// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include <nlohmann/json.hpp>

namespace argil::cli {

using Json = nlohmann::ordered_json;

/// What a finished subcommand has to say.
struct Outcome {
  Json json;         ///< the object of --json
  std::string text;  ///< the same for a person, with line ends
  int status = 0;    ///< 0 done, 1 the thing checked is not so
};

}  // namespace argil::cli
