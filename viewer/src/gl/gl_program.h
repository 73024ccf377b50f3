// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "argil/core/result.h"
#include "argil/core/vec3.h"

#include "gl/gl_object.h"
#include "picture/camera.h"

namespace argil::viewer {

/// What a program is made of. Every source begins after the lines `head`, which follow the version.
struct ProgramSource {
  const char* name = "";  ///< for errors
  std::string head;       ///< #define lines and shared functions; "": none
  const char* vertex = "";
  const char* fragment = "";
};

/// Shaders that were compiled and linked. Setting a uniform that a program does not have is
/// nothing, so that variants of one source can be set alike; the program must be in use.
class GlProgram {
 public:
  GlProgram() = default;

  /// Errors  device, with the compiler's words.
  static Result<GlProgram> make(ObjectCount& count, const ProgramSource& source);

  void use() const;
  void set(const char* uniform, int value) const;
  void set(const char* uniform, double value) const;
  void set(const char* uniform, double x, double y) const;
  void set(const char* uniform, double x, double y, double z, double w) const;
  void set(const char* uniform, const Vec3& value) const;
  void set(const char* uniform, const Matrix& value) const;

 private:
  GlProgramObject program_;
};

}  // namespace argil::viewer
