// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <exception>
#include <new>

#include "argil/core/pace.h"

namespace argil::mesh {

/// Runs what a library does for us, and tells whether it did: CGAL throws where a mesh is worse
/// than it thought of, and a repair has other ways then. What `work` had changed stays changed.
/// Interrupted and std::bad_alloc pass through.
template <class Work>
bool is_done_by_library(const Work& work) {
  try {
    work();
    return true;
  } catch (const Interrupted&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace argil::mesh
