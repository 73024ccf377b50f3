// SPDX-License-Identifier: GPL-3.0-or-later
#include "gl/gl_stream.h"

#include <cassert>

#include "gl/gl_state.h"

namespace argil::viewer {

/// The layout is set once: it remembers the buffer's name, whose storage may change.
GlStream::GlStream(ObjectCount& count, std::initializer_list<int> floats)
    : buffer_(count), layout_(count) {
  int stride = 0;
  for (const int n : floats) stride += n;
  assert(stride > 0);
  glBindVertexArray(layout_.name());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
  GLuint attribute = 0;
  std::int64_t begin = 0;
  for (const int n : floats) {
    glEnableVertexAttribArray(attribute);
    glVertexAttribPointer(attribute, n, GL_FLOAT, GL_FALSE,
                          stride * static_cast<int>(sizeof(float)), buffer_offset(begin));
    begin += n * static_cast<std::int64_t>(sizeof(float));
    ++attribute;
  }
}

void GlStream::send(const void* vertices, long bytes) const {
  assert(buffer_.is_there() && bytes >= 0);
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
  // New storage each time: the driver need not wait for draws that still read the old.
  glBufferData(GL_ARRAY_BUFFER, bytes, vertices, GL_STREAM_DRAW);
}

void GlStream::draw_sent(unsigned primitive, int vertices) const {
  assert(layout_.is_there() && vertices >= 0);
  glBindVertexArray(layout_.name());
  glDrawArrays(primitive, 0, vertices);
}

}  // namespace argil::viewer
