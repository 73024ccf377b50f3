// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <initializer_list>
#include <span>
#include <type_traits>

#include "gl/gl_object.h"

namespace argil::viewer {

/// Vertices that are written again for each draw: tightly packed floats.
class GlStream {
 public:
  GlStream() = default;
  /// How many floats each attribute has, from attribute 0 on.
  GlStream(ObjectCount& count, std::initializer_list<int> floats);

  template <class Vertex>
  void draw(unsigned primitive, std::span<const Vertex> vertices) const {
    static_assert(std::is_trivially_copyable_v<Vertex>);
    send(vertices.data(), static_cast<long>(vertices.size_bytes()));
    draw_sent(primitive, static_cast<int>(vertices.size()));
  }

  /// `draw` in two parts, for what is drawn several times.
  void send(const void* vertices, long bytes) const;
  void draw_sent(unsigned primitive, int vertices) const;

 private:
  GlBuffer buffer_;
  GlVertexArray layout_;
};

}  // namespace argil::viewer
