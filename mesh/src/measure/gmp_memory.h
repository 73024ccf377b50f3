// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace argil::mesh {

/// Numbers of GMP, which CGAL is exact with, get memory where the heap has none any more: from a
/// store of kGmpStoreBytes. What fails then is the next `new` beside them, in C++, as an error of
/// ours. GMP's own way is abort().
///
/// Throwing from its allocator would be no better. Its manual forbids it, and rightly: a product
/// gives the memory of its old value back before it asks for more (mpz_mul), so that its
/// destructor, which the exception would run, would give it back again.
///
/// Always true, to be had while constants are made: numbers of before may be freed after.
/// Threads  any; the store is never given back to.
bool gives_gmp_memory() noexcept;

inline constexpr unsigned kGmpStoreBytes = 4U << 20U;

}  // namespace argil::mesh
