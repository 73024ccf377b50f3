// SPDX-License-Identifier: GPL-3.0-or-later
#include "file/temporary_name.h"

#include <atomic>
#include <cstddef>
#include <regex>

#include <unistd.h>

namespace argil::io {

std::filesystem::path temporary_name(const std::filesystem::path& target) {
  static std::atomic<unsigned> counter{0};
  constexpr std::size_t kLongestStem = 100;  // NAME_MAX is 255
  const std::string stem = target.stem().string().substr(0, kLongestStem);
  const std::string unique = std::to_string(::getpid()) + "-" + std::to_string(counter++);
  return target.parent_path() / ("." + stem + "." + unique + target.extension().string());
}

std::string title_of(const std::filesystem::path& file) {
  static const std::regex temporary(R"(\.(.+)\.\d+-\d+)");
  const std::string stem = file.stem().string();
  std::smatch found;
  return std::regex_match(stem, found, temporary) ? found[1].str() : stem;
}

}  // namespace argil::io
