// SPDX-License-Identifier: GPL-3.0-or-later
// argil chart of a program that was built without the evaluation (ARGIL_BUILD_EVALUATION=OFF).
#include "commands.h"

namespace argil::cli {

void add_chart(CLI::App& app, Selected& selected) {
  const Work refuse = [](const Progress&) -> Result<Outcome> {
    return Error{ErrorKind::bad_input,
                 "this argil was built without its charts; configure with "
                 "-DARGIL_BUILD_EVALUATION=ON and build it again"};
  };
  CLI::App* chart = add_command(app, selected, "chart",
                                "charts of speed and accuracy: not in this build", refuse);
  chart->allow_extras();  // whatever kind and options were asked for, the answer is the same
}

}  // namespace argil::cli
