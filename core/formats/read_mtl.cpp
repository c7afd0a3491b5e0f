#include "core/formats/read_mtl.h"

#include <algorithm>
#include <filesystem>

#include "core/scene/mesh.h"

namespace copeel {
namespace {

class MtlReader {
 public:
  MtlReader(const Source& source, Materials& materials) : cursor_(source, 0, '#'), materials_(materials) {}

  void read() {
    while (!cursor_.atEnd()) {
      const std::string_view keyword = cursor_.token();
      if (keyword == "newmtl") {
        begin();
        continue;
      }
      if (current_ && keyword == "Kd") readColor();
      if (current_ && (keyword == "d" || keyword == "Tr")) readOpacity(keyword == "Tr");
      cursor_.skipLine();
    }
  }

 private:
  void begin() {
    current_ = &materials_[restAsName(cursor_)];
    *current_ = {Mesh::kNotGiven, Mesh::kNotGiven, Mesh::kNotGiven, 1};
  }

  // "Kd r" is grey; "Kd spectral file" and "Kd xyz x y z" are passed over.
  void readColor() {
    std::string_view token = cursor_.lineToken();
    if (token == "spectral" || token == "xyz") return;
    for (int channel = 0; channel < 3; ++channel) {
      if (channel > 0) {
        const std::string_view next = cursor_.lineToken();
        if (!next.empty()) token = next;
      }
      (*current_)[channel] = 255 * share(token);
    }
  }

  void readOpacity(bool turned) {
    std::string_view token = cursor_.lineToken();
    if (token == "-halo") token = cursor_.lineToken();
    current_->a = turned ? 1 - share(token) : share(token);
  }

  float share(std::string_view token) const {
    double value = 0;
    if (parseNumber(token, value) != NumberFault::None) cursor_.fail("a number from 0 to 1 should be here, found {}", quoted(token));
    return static_cast<float>(std::clamp(value, 0.0, 1.0));
  }

  TextCursor cursor_;
  Materials& materials_;
  glm::vec4* current_ = nullptr;
};

}  // namespace

std::string restAsName(TextCursor& cursor) {
  const std::string_view rest = cursor.restOfLine();
  const auto first = rest.find_first_not_of(" \t");
  return first == std::string_view::npos ? std::string() : std::string(rest.substr(first, rest.find_last_not_of(" \t") - first + 1));
}

void readMtl(const Source& source, Materials& materials) { MtlReader(source, materials).read(); }

bool addMaterials(const std::string& objPath, const std::string& library, Materials& materials) {
  const std::filesystem::path path = std::filesystem::path(objPath).parent_path() / library;
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  const InputFile file(path.string());
  readMtl(file.source().withoutByteOrderMark(), materials);
  return true;
}

}  // namespace copeel
