// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <utility>

namespace argil::viewer {

/// How many OpenGL objects live. Must outlive the objects it counts.
class ObjectCount {
 public:
  ObjectCount() = default;
  ObjectCount(const ObjectCount&) = delete;
  ObjectCount& operator=(const ObjectCount&) = delete;

  void add(int objects) noexcept;
  std::int64_t here() const noexcept { return here_; }

 private:
  std::int64_t here_ = 0;
};

enum class ObjectKind { buffer, vertex_array, texture, framebuffer, renderbuffer, program };

unsigned make_object(ObjectKind kind);
void free_object(ObjectKind kind, unsigned name) noexcept;

/// An OpenGL object that frees itself; none when made without a count. Its context must be current.
template <ObjectKind kind>
class GlObject {
 public:
  GlObject() = default;
  explicit GlObject(ObjectCount& count) : count_(&count), name_(make_object(kind)) { count.add(1); }
  GlObject(GlObject&& other) noexcept
      : count_(std::exchange(other.count_, nullptr)), name_(std::exchange(other.name_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(count_, other.count_);
    std::swap(name_, other.name_);
    return *this;
  }
  ~GlObject() {
    if (count_ == nullptr) return;
    free_object(kind, name_);
    count_->add(-1);
  }

  unsigned name() const noexcept { return name_; }
  bool is_there() const noexcept { return count_ != nullptr; }

 private:
  ObjectCount* count_ = nullptr;
  unsigned name_ = 0;
};

using GlBuffer = GlObject<ObjectKind::buffer>;
using GlVertexArray = GlObject<ObjectKind::vertex_array>;
using GlTexture = GlObject<ObjectKind::texture>;
using GlFramebuffer = GlObject<ObjectKind::framebuffer>;
using GlRenderbuffer = GlObject<ObjectKind::renderbuffer>;
using GlProgramObject = GlObject<ObjectKind::program>;

}  // namespace argil::viewer
