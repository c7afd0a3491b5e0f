#include "core/gl/program.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <system_error>

#include "core/error.h"
#include "core/gl/embedded_shaders.h"

namespace copeel::gl {
namespace {

// The file that an #include line names: in quotes, or by a define.
std::string includedFile(std::string_view row, const Defines& defines) {
  std::string name(row.substr(9, row.find_last_not_of(" \n") - 8));
  if (name.starts_with('"')) return name.substr(1, name.size() - 2);
  for (const auto& [define, value] : defines) {
    if (define == name) return value;
  }
  failMachine("gl: #include {} without a define of that name", name);
}

void appendFile(const std::string& path, const Defines& defines, std::vector<std::string>& files, std::string& source) {
  const std::size_t number = static_cast<std::size_t>(std::find(files.begin(), files.end(), path) - files.begin());
  if (number == files.size()) files.push_back(path);
  // An #if may hide the first of several inclusions, so the preprocessor has to see to it that there is one.
  source += fmt::format("#ifndef INCLUDED_{0}\n#define INCLUDED_{0}\n#line 1 {0}\n", number);
  std::string_view text = shaderText(path);
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    const std::string_view row = text.substr(0, end);
    text.remove_prefix(end);
    if (!row.starts_with("#include ")) {
      source += row;
      continue;
    }
    if (row.starts_with("#include <")) {   // C++'s part of a file that both read
      source += '\n';
      continue;
    }
    appendFile(includedFile(row, defines), defines, files, source);
    source += fmt::format("#line {} {}\n", line + 1, number);
  }
  source += "\n#endif\n";
}

struct Complaint {
  std::size_t file = 0, line = 0;
  std::string_view cause;
};

// What a row of a log complains of: Mesa writes "2:14(5): error: …", NVIDIA "2(14) : error …".
std::optional<Complaint> complaintOf(std::string_view row) {
  Complaint found;
  const char* const end = row.data() + row.size();
  const auto [afterFile, noFile] = std::from_chars(row.data(), end, found.file);
  if (noFile != std::errc() || afterFile == end || (*afterFile != ':' && *afterFile != '(')) return std::nullopt;
  if (std::from_chars(afterFile + 1, end, found.line).ec != std::errc()) return std::nullopt;
  const std::size_t colon = row.find(':', row.find("error"));
  if (colon == std::string_view::npos) return std::nullopt;
  found.cause = row.substr(std::min(row.find_first_not_of(' ', colon + 1), row.size()));
  return found;
}

// The first complaint, with the file's name for its number.
std::string firstComplaint(std::string_view log, const std::vector<std::string>& files) {
  for (std::string_view rest = log; !rest.empty();) {
    const std::string_view row = rest.substr(0, rest.find('\n'));
    if (const auto found = complaintOf(row)) {
      return fmt::format("{}:{}: {}", found->file < files.size() ? files[found->file] : "?", found->line, found->cause);
    }
    rest.remove_prefix(std::min(row.size() + 1, rest.size()));
  }
  return std::string(log.substr(0, log.find('\n')));
}

void compileInto(GLuint program, GLenum stage, const std::string& path, const Defines& defines) {
  std::vector<std::string> files;
  const std::string source = shaderSource(path, defines, files);
  const char* text = source.c_str();
  const GLuint shader = glCreateShader(stage);
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  GLint good = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) glAttachShader(program, shader);
  std::string log(4096, '\0');
  GLsizei length = 0;
  if (!good) glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  glDeleteShader(shader);
  if (!good) failMachine("gl: {}", firstComplaint(log.substr(0, static_cast<std::size_t>(length)), files));
}

// What a program is called that does not link: a pixel pass by its own file.
const std::string& calledAfter(const std::string& path, const Defines& defines) {
  for (const auto& [name, value] : defines) {
    if (name == "PIXEL_PASS") return value;
  }
  return path;
}

void link(GLuint program, const std::string& path) {
  glLinkProgram(program);
  GLint good = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &good);
  if (good) return;
  std::string log(4096, '\0');
  GLsizei length = 0;
  glGetProgramInfoLog(program, static_cast<GLsizei>(log.size()), &length, log.data());
  failMachine("gl: {}: {}", path, log.substr(0, std::min<std::size_t>(static_cast<std::size_t>(length), log.find('\n'))));
}

}  // namespace

std::string_view shaderText(std::string_view path) {
  for (const EmbeddedShader& shader : embeddedShaders()) {
    if (shader.path == path) return shader.text;
  }
  failMachine("gl: no shader file {}", path);
}

std::string shaderSource(const std::string& path, const Defines& defines, std::vector<std::string>& files) {
  std::string source = "#version 450 core\n";
  for (const auto& [name, value] : defines) {
    if (!value.ends_with(".glsl")) source += fmt::format("#define {} {}\n", name, value);
  }
  appendFile(path, defines, files, source);
  return source;
}

Program::Program(const std::string& vertexPath, const std::string& fragmentPath, const Defines& defines) : name_(glCreateProgram()) {
  compileInto(name_, GL_VERTEX_SHADER, vertexPath, defines);
  compileInto(name_, GL_FRAGMENT_SHADER, fragmentPath, defines);
  link(name_, calledAfter(fragmentPath, defines));
}

Program::Program(const std::string& computePath, const Defines& defines) : name_(glCreateProgram()) {
  compileInto(name_, GL_COMPUTE_SHADER, computePath, defines);
  link(name_, computePath);
}

const Program& Programs::find(const std::string& vertexPath, const std::string& fragmentPath, const Defines& defines) {
  const Made made{vertexPath, fragmentPath, defines};
  const auto found = programs_.find(made);
  if (found != programs_.end()) return found->second;
  return programs_.emplace(made, fragmentPath.empty() ? Program(vertexPath, defines) : Program(vertexPath, fragmentPath, defines)).first->second;
}

std::vector<Programs::Made> Programs::all() const {
  std::vector<Made> all;
  for (const auto& [made, program] : programs_) all.push_back(made);
  return all;
}

}  // namespace copeel::gl
