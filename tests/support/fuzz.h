// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <random>
#include <string>
#include <vector>

#include <time.h>

#include "support/scratch.h"

namespace argil::test {

/// Damaged inputs out of a folder of good ones, tests/corpus/NAME; the same series every time.
/// Tests run in the root of the repository.
class Fuzzer {
 public:
  explicit Fuzzer(const std::string& name) {
    const std::filesystem::path folder = std::filesystem::path("tests/corpus") / name;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      seeds_.push_back(content_of(entry.path()));
    }
    std::sort(seeds_.begin(), seeds_.end());
  }

  const std::vector<std::string>& seeds() const noexcept { return seeds_; }

  /// A seed after some to many mutations.
  std::string next() {
    std::string input = pick();
    for (std::size_t n = below(12); n-- > 0;) mutate(input);
    return input;
  }

  std::size_t below(std::size_t end) { return random_() % end; }

 private:
  static constexpr std::size_t kMostBytes = 4096;

  const std::string& pick() { return seeds_[below(seeds_.size())]; }
  char byte() {
    // What is common in the inputs is more often worth trying than any byte.
    constexpr std::string_view kTelling = "<>APQ=,#.-0123456789eEnif\n\r\0\xAA\x08\xFF\x7F";
    return below(2) == 0 ? kTelling[below(kTelling.size())] : static_cast<char>(below(256));
  }

  void mutate(std::string& input) {
    const std::size_t at = below(input.size() + 1);
    const std::size_t count = std::min(input.size() - at, 1 + below(8));
    switch (below(6)) {
      case 0:
        if (at < input.size()) input[at] = byte();
        break;
      case 1:
        if (at < input.size()) input[at] = static_cast<char>(input[at] ^ (1 << below(8)));
        break;
      case 2:
        input.insert(at, 1, byte());
        break;
      case 3:
        input.erase(at, count);
        break;
      case 4:
        input.insert(at, input.substr(below(input.size() + 1), count));
        break;
      default:
        input = input.substr(0, at) + pick().substr(0, 64);
        break;
    }
    if (input.size() > kMostBytes) input.resize(kMostBytes);
  }

  std::vector<std::string> seeds_;
  std::mt19937_64 random_{1};
};

/// Feeds `check` damaged inputs for so many seconds of CPU; returns how many.
template <class Check>
std::uint64_t fuzz_for(Fuzzer& fuzzer, double seconds, const Check& check) {
  const auto cpu_s = [] {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  };
  std::uint64_t inputs = 0;
  for (const double end_s = cpu_s() + seconds; cpu_s() < end_s;) {
    for (int n = 0; n < 256; ++n, ++inputs) check(fuzzer.next());
  }
  return inputs;
}

}  // namespace argil::test
