// SPDX-License-Identifier: Zlib
#include "command/pictures/gl/ShaderProgram.h"

#include <stdexcept>
#include <string>

namespace pictures {
namespace {

GLuint compiled(GLenum kind, const ShaderProgram::Pieces& pieces) {
  std::vector<const char*> texts;
  std::vector<GLint> lengths;
  for (const std::string_view piece : pieces) {
    texts.push_back(piece.data());
    lengths.push_back(static_cast<GLint>(piece.size()));
  }
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, static_cast<GLsizei>(texts.size()), texts.data(), lengths.data());
  glCompileShader(shader);
  GLint isCompiled = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &isCompiled);
  if (isCompiled == GL_TRUE) return shader;
  char complaint[512] = "";
  glGetShaderInfoLog(shader, sizeof complaint, nullptr, complaint);
  glDeleteShader(shader);
  throw std::runtime_error(std::string("OpenGL refuses a shader: ") + complaint);
}

}  // namespace

ShaderProgram::ShaderProgram(const Pieces& vertexShader, const Pieces& fragmentShader) : m_program(glCreateProgram()) {
  for (const GLuint shader : {compiled(GL_VERTEX_SHADER, vertexShader), compiled(GL_FRAGMENT_SHADER, fragmentShader)}) {
    glAttachShader(m_program, shader);
    glDeleteShader(shader);  // once the program is gone
  }
  glLinkProgram(m_program);
  GLint isLinked = GL_FALSE;
  glGetProgramiv(m_program, GL_LINK_STATUS, &isLinked);
  if (isLinked == GL_TRUE) return;
  char complaint[512] = "";
  glGetProgramInfoLog(m_program, sizeof complaint, nullptr, complaint);
  glDeleteProgram(m_program);
  throw std::runtime_error(std::string("OpenGL cannot link shaders: ") + complaint);
}

ShaderProgram::~ShaderProgram() { glDeleteProgram(m_program); }

void ShaderProgram::use() const { glUseProgram(m_program); }

GLint ShaderProgram::locationOf(const char* name) const { return glGetUniformLocation(m_program, name); }

void ShaderProgram::set(const char* name, int value) const { glUniform1i(locationOf(name), value); }

void ShaderProgram::set(const char* name, float value) const { glUniform1f(locationOf(name), value); }

void ShaderProgram::set(const char* name, float first, float second) const {
  glUniform2f(locationOf(name), first, second);
}

void ShaderProgram::set(const char* name, const Vector3& value) const {
  glUniform3fv(locationOf(name), 1, value.data());
}

void ShaderProgram::set(const char* name, const Matrix4& value) const {
  glUniformMatrix4fv(locationOf(name), 1, GL_FALSE, value.data());
}

void ShaderProgram::bindBlock(const char* name, GLuint binding) const {
  const GLuint index = glGetUniformBlockIndex(m_program, name);
  if (index != GL_INVALID_INDEX) glUniformBlockBinding(m_program, index, binding);
}

}  // namespace pictures
