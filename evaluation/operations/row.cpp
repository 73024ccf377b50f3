// SPDX-License-Identifier: GPL-3.0-or-later
#include "operations/row.h"

#include <span>

#include "argil/core/hash.h"

#include "common/machine.h"
#include "common/output.h"

namespace argil::evaluation {

void describe_result(const TriangleMesh& result, OperationRow& row) {
  row.vertices = static_cast<std::int64_t>(result.positions.size());
  Hash64 hash;
  hash.update(std::as_bytes(std::span(result.positions)));
  row.hash = hash.digest();
}

std::string operations_csv(const std::vector<OperationRow>& rows) {
  std::string text =
      "# Operations on " + cli::machine_name() +
      "; CPU time of all threads, of the operation alone, median with least and greatest of the "
      "runs; errors in finest voxels\n"
      "operation,body,method,million,vertices,cpu_s,least_cpu_s,most_cpu_s,wall_s,runs,p50,p99,rms,"
      "max,missed,seam,hash\n";
  const auto add = [&](const std::string& field) { text.append(field).append(","); };
  const auto add_optional = [&](const std::optional<double>& value) {
    add(value ? cli::number(*value) : "");
  };
  for (const OperationRow& row : rows) {
    for (const std::string& name : {row.operation, row.body, row.method}) add(name);
    add(cli::number(row.million));
    add(std::to_string(row.vertices));
    for (const double seconds : {row.cpu_s, row.least_cpu_s, row.most_cpu_s, row.wall_s}) {
      add(cli::number(seconds));
    }
    add(std::to_string(row.runs));
    add_optional(row.error.p50);
    add_optional(row.error.p99);
    add(cli::number(row.error.rms));
    add(cli::number(row.error.max));
    add_optional(row.error.missed);
    add_optional(row.error.seam);
    text.append(cli::hex(row.hash)).append("\n");
  }
  return text;
}

}  // namespace argil::evaluation
