// Shaders: plain .glsl files, embedded when the program is built, specialised by defines.
//
// `#include "path"` names a file from the source's root and takes it in once; `#include NAME` the file that the define NAME has as its value. What a driver says of a shader names the file and line.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/gl/functions.h"
#include "core/gl/objects.h"

namespace copeel::gl {

using Defines = std::vector<std::pair<std::string, std::string>>;

// The embedded text of a file; throws Error{Machine} when there is none.
std::string_view shaderText(std::string_view path);

// The whole source that a driver is given: version, defines, the file with what it includes. `files` gets their names by `#line` number.
std::string shaderSource(const std::string& path, const Defines& defines, std::vector<std::string>& files);

inline void deleteProgram(GLuint name) { glDeleteProgram(name); }

class Program {
 public:
  Program(const std::string& vertexPath, const std::string& fragmentPath, const Defines& defines);
  explicit Program(const std::string& computePath, const Defines& defines = {});

  GLuint name() const { return name_; }
  void set(const char* uniform, GLuint value) const { glProgramUniform1ui(name_, glGetUniformLocation(name_, uniform), value); }
  void set(const char* uniform, GLint value) const { glProgramUniform1i(name_, glGetUniformLocation(name_, uniform), value); }

 private:
  Handle<deleteProgram> name_;
};

// Programs by what they are made of, so that a frame compiles nothing that an earlier one did.
class Programs {
 public:
  // With an empty fragmentPath, vertexPath is a compute shader's.
  const Program& find(const std::string& vertexPath, const std::string& fragmentPath, const Defines& defines);

  // What each program was made of, for tests that give it to another compiler.
  struct Made {
    std::string vertexPath, fragmentPath;
    Defines defines;
    friend auto operator<=>(const Made&, const Made&) = default;
  };
  std::vector<Made> all() const;

 private:
  std::map<Made, Program> programs_;
};

}  // namespace copeel::gl
