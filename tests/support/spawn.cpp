// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/spawn.h"

#include <algorithm>
#include <stdexcept>

#include <spawn.h>
#include <unistd.h>

namespace argil::test {
namespace {

bool has_name_of(const std::vector<std::string>& variables, const std::string& other) {
  const std::string name = other.substr(0, other.find('=') + 1);
  return std::any_of(variables.begin(), variables.end(), [&](const std::string& one) {
    return one.compare(0, name.size(), name) == 0;
  });
}

std::vector<char*> pointers_to(std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

pid_t spawn(const std::string& program, const std::vector<std::string>& arguments,
            const std::vector<std::string>& variables) {
  std::vector<std::string> words{program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<std::string> environment = variables;
  for (char** variable = ::environ; *variable != nullptr; ++variable) {
    if (!has_name_of(variables, *variable)) environment.emplace_back(*variable);
  }
  pid_t child = -1;
  if (::posix_spawn(&child, program.c_str(), nullptr, nullptr, pointers_to(words).data(),
                    pointers_to(environment).data()) != 0) {
    throw std::runtime_error("cannot start " + program);
  }
  return child;
}

}  // namespace argil::test
