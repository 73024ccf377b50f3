#include "chart/force_plot.h"
namespace argil::cli::chart {
std::vector<Script> force_scripts(const std::vector<ForceRow>&, const std::vector<ForceRow>&,
                                  const Floor&, const std::string&) {
  return {};
}
}  // namespace argil::cli::chart
