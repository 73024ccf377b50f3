// SPDX-License-Identifier: GPL-3.0-or-later
#include "argil/core/hash.h"

#include <new>

#define XXH_INLINE_ALL  // fixes the state's size at compile time: no ABI to depend on
#include <xxhash.h>

namespace argil {
namespace {

static_assert(sizeof(XXH64_state_t) <= 88 && alignof(XXH64_state_t) <= 8,
              "Hash64::state_ must hold xxhash's state");

}  // namespace

Hash64::Hash64() noexcept : state_{} {
  XXH64_reset(::new (static_cast<void*>(state_.data())) XXH64_state_t, 0);
}

void Hash64::update(std::span<const std::byte> bytes) noexcept {
  if (bytes.empty()) return;  // xxhash refuses a null pointer even of length 0
  // The object was made in these bytes by placement new; launder makes a pointer to it valid.
  auto* state = std::launder(reinterpret_cast<XXH64_state_t*>(state_.data()));
  XXH64_update(state, bytes.data(), bytes.size());
}

std::uint64_t Hash64::digest() const noexcept {
  return XXH64_digest(std::launder(reinterpret_cast<const XXH64_state_t*>(state_.data())));
}

}  // namespace argil
