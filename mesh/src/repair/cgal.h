// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iterator>
#include <vector>

#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/version.h>
#if CGAL_VERSION_NR >= 1060000000
#include <variant>
#else
#include <boost/variant/get.hpp>
#endif

#include "measure/gmp_memory.h"

/// CGAL 5.5 (Debian 12) and 6 (Debian 13): what differs between them is here and nowhere else.
namespace argil::mesh {

/// Set before main, once for all that is linked with CGAL: no number is made, and no thread runs.
inline const bool kGmpHasMemory = gives_gmp_memory();

/// What an intersection is where it is a T, or null.
template <class T, class Variant>
const T* held(const Variant& intersection) {
#if CGAL_VERSION_NR >= 1060000000
  return std::get_if<T>(&intersection);
#else
  return boost::get<T>(&intersection);
#endif
}

/// Fills the hole at `border`, refines and fairs the patch, and gives its faces and the vertices it
/// adds.
template <class Mesh, class Halfedge, class Face, class Vertex>
void fill_hole_fairly(Mesh& mesh, Halfedge border, bool is_long, std::vector<Face>& faces,
                      std::vector<Vertex>& vertices) {
  namespace pmp = CGAL::Polygon_mesh_processing;
  const auto parameters = CGAL::parameters::do_not_use_cubic_algorithm(is_long);
#if CGAL_VERSION_NR >= 1060000000
  pmp::triangulate_refine_and_fair_hole(mesh, border,
                                        parameters.face_output_iterator(std::back_inserter(faces))
                                            .vertex_output_iterator(std::back_inserter(vertices)));
#else
  pmp::triangulate_refine_and_fair_hole(mesh, border, std::back_inserter(faces),
                                        std::back_inserter(vertices), parameters);
#endif
}

}  // namespace argil::mesh
