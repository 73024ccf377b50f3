// SPDX-License-Identifier: GPL-3.0-or-later
#include "measure/gmp_memory.h"

#include <cstdlib>
#include <new>

#include <gmp.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "argil/mesh/close.h"

#include "support/shapes.h"

namespace argil::mesh {
namespace {

constexpr int kFine = 0;
constexpr int kWrongNumber = 1;
constexpr int kHadMemory = 2;

/// From here on malloc and new have nothing left.
void use_up_the_heap() {
  rlimit limit{};
  ::getrlimit(RLIMIT_DATA, &limit);
  limit.rlim_cur = 1;  // what is there stays, and no page comes; 0 means no limit to Linux
  ::setrlimit(RLIMIT_DATA, &limit);
  for (std::size_t bytes = std::size_t{1} << 20U; bytes >= 8; bytes /= 2) {
    while (std::malloc(bytes) != nullptr) continue;
  }
}

/// 3^20000 mod 10^9 + 7 of one number that grows, and a `new` after it.
[[noreturn]] void count_without_a_heap() {
  constexpr unsigned kTimes = 200;
  use_up_the_heap();
  mpz_t product;
  mpz_t three;
  mpz_init_set_ui(product, 1);
  mpz_init_set_ui(three, 3);
  mpz_pow_ui(three, three, 100);
  for (unsigned n = 0; n < kTimes; ++n) mpz_mul(product, product, three);
  unsigned long expected = 1;
  for (unsigned n = 0; n < 100 * kTimes; ++n) expected = expected * 3 % 1'000'000'007UL;
  const bool is_right = mpz_fdiv_ui(product, 1'000'000'007UL) == expected;
  mpz_clear(product);
  mpz_clear(three);
  if (!is_right) ::_exit(kWrongNumber);
  try {
    char* volatile block = new char[std::size_t{1} << 20U];  // more than the numbers gave back
    block[0] = 0;
  } catch (const std::bad_alloc&) {
    ::_exit(kFine);
  }
  ::_exit(kHadMemory);
}

/// GMP's own answer is abort(); what fails now is the next `new` in C++.
TEST(GmpMemory, OutlivesTheHeap) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer has a heap of its own";
#endif
  // Links what CGAL is in, where the numbers' memory is set.
  ASSERT_TRUE(close_mesh(test::box_mesh({1.0, 1.0, 1.0})));
  EXPECT_EXIT(count_without_a_heap(), testing::ExitedWithCode(kFine), "");
}

TEST(GmpMemory, IsOfTheHeapAsLongAsThereIsOne) {
  ASSERT_TRUE(gives_gmp_memory());
  void* (*allocate)(std::size_t) = nullptr;
  void* (*resize)(void*, std::size_t, std::size_t) = nullptr;
  void (*release)(void*, std::size_t) = nullptr;
  mp_get_memory_functions(&allocate, &resize, &release);
  auto* block = static_cast<unsigned char*>(allocate(2 * std::size_t{kGmpStoreBytes}));
  block[0] = 7;
  block = static_cast<unsigned char*>(
      resize(block, 2 * std::size_t{kGmpStoreBytes}, 3 * std::size_t{kGmpStoreBytes}));
  EXPECT_EQ(block[0], 7);
  release(block, 3 * std::size_t{kGmpStoreBytes});
}

}  // namespace
}  // namespace argil::mesh
