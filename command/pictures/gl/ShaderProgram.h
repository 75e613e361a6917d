// SPDX-License-Identifier: Zlib
#pragma once

#include "command/pictures/FrameSequence.h"
#include "command/pictures/Matrix4.h"

#include <epoxy/gl.h>

#include <string_view>
#include <vector>

namespace pictures {

/// Shaders, linked. Each is given as pieces, which are put one after the other.
class ShaderProgram {
 public:
  using Pieces = std::vector<std::string_view>;

  /// Throws std::runtime_error with the driver's complaint.
  ShaderProgram(const Pieces& vertexShader, const Pieces& fragmentShader);
  ~ShaderProgram();
  ShaderProgram(const ShaderProgram&) = delete;
  ShaderProgram& operator=(const ShaderProgram&) = delete;

  void use() const;
  // Of the program in use.
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, float first, float second) const;
  void set(const char* name, const Vector3& value) const;
  void set(const char* name, const Matrix4& value) const;
  void bindBlock(const char* name, GLuint binding) const;

 private:
  GLint locationOf(const char* name) const;

  GLuint m_program;
};

}  // namespace pictures
