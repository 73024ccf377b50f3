// SPDX-License-Identifier: GPL-3.0-or-later
// What of the machine belongs beside a measurement: its name, its clocks, its bandwidth.
#include "common/machine.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <fstream>
#include <thread>
#include <vector>

#include <time.h>

namespace argil::cli {
namespace {

/// Enough sums side by side that the additions do not wait for each other.
constexpr std::size_t kLanes = 64;

float sum_of(const std::vector<float>& values) {
  std::array<float, kLanes> sums{};
  for (std::size_t i = 0; i + kLanes <= values.size(); i += kLanes) {
    for (std::size_t lane = 0; lane < kLanes; ++lane) sums[lane] += values[i + lane];
  }
  float sum = 0.0F;
  for (const float each : sums) sum += each;
  return sum;
}

double clock_us(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

}  // namespace

std::string machine_name() {
  std::ifstream file("/proc/cpuinfo");
  std::string line;
  std::string model = "unknown processor";
  while (std::getline(file, line)) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) {
      model = line.substr(colon + 2);
      break;
    }
  }
  const unsigned cores = std::thread::hardware_concurrency();
  return model + ", " + std::to_string(cores) + (cores == 1 ? " core" : " cores");
}

double thread_cpu_us() { return clock_us(CLOCK_THREAD_CPUTIME_ID); }
double process_cpu_us() { return clock_us(CLOCK_PROCESS_CPUTIME_ID); }

double read_bandwidth(std::size_t bytes) {
  constexpr int kPasses = 50;
  constexpr std::size_t kBytesPerPass = 16U << 20U;
  assert(bytes >= sizeof(float) && bytes <= kBytesPerPass);
  const std::vector<float> values(bytes / sizeof(float), 1.0F);
  const std::size_t repeats = kBytesPerPass / bytes;
  volatile float kept = 0.0F;  // so that no sum is left out
  double best = 0.0;
  for (int pass = 0; pass < kPasses; ++pass) {
    const double before = thread_cpu_us();
    for (std::size_t i = 0; i < repeats; ++i) kept = kept + sum_of(values);
    const double passed = thread_cpu_us() - before;
    // The best pass is the one that nothing disturbed.
    best = std::max(best, static_cast<double>(repeats * bytes) / passed);
  }
  return best;
}

}  // namespace argil::cli
