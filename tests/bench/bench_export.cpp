// SPDX-License-Identifier: GPL-3.0-or-later
// What a large export takes, step by step: CPU and wall time and the most memory that was held
// above what the clay itself holds. Prints a markdown table with the error beside the time; of
// several runs the medians. Usage: bench_export [millions of triangles [file [runs]]]; the
// default is 1, argil_bench_export.3mf in the folder for temporary files, and 1 run; 10 million
// take three minutes
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

#include "argil/io/export.h"

#include "bench/clock.h"
#include "bench/memory.h"
#include "support/bumpy_clay.h"

namespace argil::bench {
namespace {

constexpr double kVoxelMm = 0.1;
/// Of the surface of a ball, per voxel^2.
constexpr double kTrianglesPerSquareVoxel = 3.0;

/// From now on VmHWM is the most since now.
void forget_peak() { std::ofstream("/proc/self/clear_refs") << 5; }

struct Step {
  std::string name;
  std::vector<double> cpu_s;  ///< of each run
  std::vector<double> wall_s;
  double peak_mb = 0.0;
};

/// Notes what each stage that progress tells of took.
class Steps {
 public:
  explicit Steps(double start_mb) : start_mb_(start_mb) {}

  bool operator()(std::string_view stage) {
    if (name_ != stage) {
      close();
      name_ = stage;
      cpu_ms_ = process_cpu_ms();
      wall_ms_ = wall_ms();
      forget_peak();
    }
    return true;
  }
  void close() {
    if (name_.empty()) return;
    auto step = std::find_if(all_.begin(), all_.end(),
                             [&](const Step& each) { return each.name == name_; });
    if (step == all_.end()) step = all_.insert(all_.end(), Step{name_, {}, {}, 0.0});
    step->cpu_s.push_back(1e-3 * (process_cpu_ms() - cpu_ms_));
    step->wall_s.push_back(1e-3 * (wall_ms() - wall_ms_));
    step->peak_mb = std::max(step->peak_mb, status_mb("VmHWM") - start_mb_);
    name_.clear();
  }
  const std::vector<Step>& all() const { return all_; }

 private:
  double start_mb_;
  std::string name_;
  double cpu_ms_ = 0.0;
  double wall_ms_ = 0.0;
  std::vector<Step> all_;
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

int run(double millions, const std::filesystem::path& file, int runs) {
  const double area = 1e6 * millions / kTrianglesPerSquareVoxel;
  const double radius = kVoxelMm * std::sqrt(area / (4.0 * std::numbers::pi));
  const auto clay = test::bumpy_ball(radius, kVoxelMm);
  if (!clay) {
    std::fprintf(stderr, "bench_export: %s\n", clay.error().message.c_str());
    return 1;
  }
  Steps steps(status_mb("VmRSS"));
  Step whole{"whole", {}, {}, 0.0};
  double count = 0.0;
  for (int n = 0; n < runs; ++n) {
    const double cpu_ms = process_cpu_ms();
    const double start_ms = wall_ms();
    const auto report = io::export_mesh(
        file, clay.value(), [&](std::string_view stage, double) { return steps(stage); });
    steps.close();
    whole.cpu_s.push_back(1e-3 * (process_cpu_ms() - cpu_ms));
    whole.wall_s.push_back(1e-3 * (wall_ms() - start_ms));
    if (!report) {
      std::fprintf(stderr, "bench_export: %s\n", report.error().message.c_str());
      return 1;
    }
    count = static_cast<double>(report.value().triangles);
    if (n > 0) continue;
    std::printf(
        "%.2f million triangles, %s, error %.4f mm at most (voxel %.1f mm), file %.1f MB\n\n",
        1e-6 * count, report.value().verdict.printable ? "printable" : "NOT printable",
        report.value().max_error_mm, kVoxelMm,
        1e-6 * static_cast<double>(std::filesystem::file_size(file)));
  }
  std::filesystem::remove(file);
  std::printf("| step | CPU us a triangle | wall us a triangle | most MB | bytes a triangle |\n");
  std::printf("|---|---|---|---|---|\n");
  const auto print = [&](const Step& step) {
    std::printf("| %s | %.2f | %.2f | %.0f | %.0f |\n", step.name.c_str(),
                1e6 * median(step.cpu_s) / count, 1e6 * median(step.wall_s) / count, step.peak_mb,
                1048576.0 * step.peak_mb / count);
  };
  for (const Step& step : steps.all()) print(step);
  for (const Step& step : steps.all()) whole.peak_mb = std::max(whole.peak_mb, step.peak_mb);
  print(whole);
  return 0;
}

}  // namespace
}  // namespace argil::bench

int main(int argc, char** argv) {
  const auto file = std::filesystem::temp_directory_path() / "argil_bench_export.3mf";
  return argil::bench::run(argc > 1 ? std::atof(argv[1]) : 1.0,
                           argc > 2 ? std::filesystem::path(argv[2]) : file,
                           argc > 3 ? std::max(1, std::atoi(argv[3])) : 1);
}
