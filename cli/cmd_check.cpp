// SPDX-License-Identifier: GPL-3.0-or-later
// argil check: would a print service take this mesh?
#include <memory>

#include "argil/io/mesh_check.h"
#include "argil/io/mesh_file.h"

#include "command.h"
#include "options.h"
#include "output.h"

namespace argil::cli {
namespace {

struct CheckOptions {
  std::string mesh;
  double min_wall_mm = 0.0;
};

Result<Outcome> run_check(const CheckOptions& options) {
  if (auto input = check_input(options.mesh); !input) return input.error();
  const auto mesh = io::read_mesh(options.mesh);
  if (!mesh) return mesh.error();
  if (auto stop = check_interrupt(); !stop) return stop.error();
  const io::MeshVerdict verdict = io::check_mesh(mesh.value(), options.min_wall_mm);
  Outcome outcome;
  outcome.json = to_json(verdict);
  outcome.json["triangles"] = mesh.value().triangles.size();
  outcome.text = grouped(static_cast<std::int64_t>(mesh.value().triangles.size())) +
                 " triangles\n" + verdict_text(verdict);
  outcome.status = verdict.printable ? 0 : 1;
  return outcome;
}

}  // namespace

void add_check(CLI::App& app, Selected& selected) {
  auto options = std::make_shared<CheckOptions>();
  CLI::App* command =
      add_command(app, selected, "check", "judge a mesh for printing; status 1 when it is not",
                  [options](const Progress&) { return run_check(*options); });
  command->add_option("MESH", options->mesh, "OBJ, STL, PLY or 3MF")->required();
  add_number(*command, "--min-wall-mm", options->min_wall_mm, kPositive,
             "also measure walls and report those thinner than this");
}

}  // namespace argil::cli
