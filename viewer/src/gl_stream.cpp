// SPDX-License-Identifier: GPL-3.0-or-later
#include "gl_stream.h"

#include <epoxy/gl.h>

namespace argil::viewer {

GlStream::GlStream(ObjectCount& count, std::initializer_list<int> floats)
    : buffer_(count), layout_(count) {
  int stride = 0;
  for (const int n : floats) stride += n;
  glBindVertexArray(layout_.name());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
  GLuint attribute = 0;
  std::size_t begin = 0;
  for (const int n : floats) {
    glEnableVertexAttribArray(attribute);
    glVertexAttribPointer(attribute, n, GL_FLOAT, GL_FALSE,
                          stride * static_cast<int>(sizeof(float)),
                          reinterpret_cast<const void*>(begin * sizeof(float)));
    begin += static_cast<std::size_t>(n);
    ++attribute;
  }
}

void GlStream::send(const void* vertices, long bytes) const {
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
  glBufferData(GL_ARRAY_BUFFER, bytes, vertices, GL_STREAM_DRAW);
}

void GlStream::draw_sent(unsigned primitive, int vertices) const {
  glBindVertexArray(layout_.name());
  glDrawArrays(primitive, 0, vertices);
}

}  // namespace argil::viewer
