// SPDX-License-Identifier: GPL-3.0-or-later
#include "gl/gl_program.h"

#include <array>
#include <cassert>
#include <optional>

#include <epoxy/gl.h>

namespace argil::viewer {
namespace {

constexpr const char* kVersion = "#version 330 core\n";

/// Attaches a shader, which lives as long as the program then. Returns why it could not.
std::optional<std::string> attach_shader(unsigned program, GLenum type, const ProgramSource& source,
                                         const char* text) {
  const GLuint shader = glCreateShader(type);
  const std::array<const GLchar*, 3> parts{kVersion, source.head.c_str(), text};
  glShaderSource(shader, static_cast<GLsizei>(parts.size()), parts.data(), nullptr);
  glCompileShader(shader);
  GLint compiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  std::array<GLchar, 1024> log{};
  if (compiled != GL_TRUE) glGetShaderInfoLog(shader, log.size(), nullptr, log.data());
  glAttachShader(program, shader);
  glDeleteShader(shader);
  if (compiled == GL_TRUE) return std::nullopt;
  return std::string(log.data());
}

/// Returns why it could not be linked.
std::optional<std::string> link(unsigned program) {
  glLinkProgram(program);
  GLint linked = GL_FALSE;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return std::nullopt;
  std::array<GLchar, 1024> log{};
  glGetProgramInfoLog(program, log.size(), nullptr, log.data());
  return std::string(log.data());
}

float as_float(double value) { return static_cast<float>(value); }

}  // namespace

Result<GlProgram> GlProgram::make(ObjectCount& count, const ProgramSource& source) {
  GlProgram made;
  made.program_ = GlProgramObject(count);
  const unsigned name = made.program_.name();
  auto failure = attach_shader(name, GL_VERTEX_SHADER, source, source.vertex);
  if (!failure) failure = attach_shader(name, GL_FRAGMENT_SHADER, source, source.fragment);
  if (!failure) failure = link(name);
  if (!failure) return made;
  return Error{ErrorKind::device, std::string("OpenGL does not take the shader ") + source.name +
                                      ": " + *failure + "; update the graphics driver"};
}

void GlProgram::use() const {
  assert(program_.is_there());
  glUseProgram(program_.name());
}

// A uniform that a shader does not use has the location -1, which OpenGL passes over silently: the
// same values are set for all shadings, whatever each of them reads. Asked by name each time, which
// happens some dozens of times a picture.

void GlProgram::set(const char* uniform, int value) const {
  glUniform1i(glGetUniformLocation(program_.name(), uniform), value);
}

void GlProgram::set(const char* uniform, double value) const {
  glUniform1f(glGetUniformLocation(program_.name(), uniform), as_float(value));
}

void GlProgram::set(const char* uniform, double x, double y) const {
  glUniform2f(glGetUniformLocation(program_.name(), uniform), as_float(x), as_float(y));
}

void GlProgram::set(const char* uniform, double x, double y, double z, double w) const {
  glUniform4f(glGetUniformLocation(program_.name(), uniform), as_float(x), as_float(y), as_float(z),
              as_float(w));
}

void GlProgram::set(const char* uniform, const Vec3& value) const {
  glUniform3f(glGetUniformLocation(program_.name(), uniform), as_float(value.x), as_float(value.y),
              as_float(value.z));
}

void GlProgram::set(const char* uniform, const Matrix& value) const {
  glUniformMatrix4fv(glGetUniformLocation(program_.name(), uniform), 1, GL_FALSE, value.data());
}

}  // namespace argil::viewer
