// OBJ (Wavefront): v and f lines make the mesh, and where wanted the materials its colours; what else only looks or names (normals, groups) and
// what has no area (points, lines) is passed over. Curved surfaces would be lost in silence and are an error, as is any unknown keyword.
#include <algorithm>
#include <array>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/formats/read_mtl.h"
#include "core/formats/readers.h"
#include "core/formats/soup_builder.h"
#include "core/formats/text_cursor.h"

namespace copeel {
namespace {

constexpr std::array<std::string_view, 30> kPassedOver = {
    "vt",     "vn",     "vp",     "g",     "o",        "s",        "mg",   "l",          "p",         "usemtl",
    "mtllib", "usemap", "maplib", "bevel", "c_interp", "d_interp", "lod",  "shadow_obj", "trace_obj", "cstype",
    "deg",    "bmat",   "step",   "parm",  "trim",     "hole",     "scrv", "sp",         "end",       "con"};
constexpr std::array<std::string_view, 9> kNotRead = {"curv", "curv2", "surf", "bzp", "bsp",
                                                      "cdc",  "cdp",   "call", "csh"};

template <std::size_t n>
bool isOneOf(const std::array<std::string_view, n>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

class ObjReader {
 public:
  ObjReader(const Source& source, const ReadMeshOptions& options)
      : source_(source), options_(options), cursor_(source, 0, '#'), builder_(source, SoupBuilder::Place::Line, 1) {}

  Mesh read() {
    while (!cursor_.atEnd()) readLine();
    return builder_.finish();
  }

 private:
  void readLine() {
    const std::string_view keyword = cursor_.token();
    if (keyword == "v") {
      readVertex();
    } else if (keyword == "f" || keyword == "fo") {
      readFace();
    } else if (options_.colors && keyword == "mtllib") {
      readLibrary();
    } else if (options_.colors && keyword == "usemtl") {
      useMaterial();
    } else if (isOneOf(kNotRead, keyword)) {
      cursor_.fail("curved surfaces and calls are not read ({})", keyword);
    } else if (!isOneOf(kPassedOver, keyword)) {
      cursor_.fail("{} is no OBJ keyword", quoted(keyword));
    }
    skipLogicalLine();
  }

  template <class... Args>
  void warn(std::size_t place, fmt::format_string<Args...> format, Args&&... args) {
    if (options_.warnings) {
      options_.warnings->push_back(fmt::format("{}:{}: {}", source_.name(), source_.lineOf(place), fmt::format(format, std::forward<Args>(args)...)));
    }
  }

  // "mtllib a.mtl b.mtl" names two files, unless there is one of that name.
  void readLibrary() {
    const std::size_t place = cursor_.place();
    const std::string names = restAsName(cursor_);
    lineTaken_ = true;
    if (addMaterials(source_.name(), names, materials_)) return;
    std::istringstream list(names);
    for (std::string name; list >> name;) {
      if (addMaterials(source_.name(), name, materials_)) continue;
      warn(place, "no material library {}: its colours are missing", Source({}, name).name());
      librariesMissing_ = true;
    }
  }

  void useMaterial() {
    const std::size_t place = cursor_.place();
    const std::string name = restAsName(cursor_);
    lineTaken_ = true;
    const auto found = materials_.find(name);
    if (found != materials_.end()) {
      builder_.setFaceColor(found->second);
    } else {
      builder_.setFaceColor(glm::vec4(Mesh::kNotGiven));
      if (!librariesMissing_ && unknown_.insert(name).second) warn(place, "no material {} in the libraries", Source({}, name).name());
    }
  }

  // The next token of the line, going on where a backslash ends the line; empty at its end.
  std::string_view lineToken() {
    for (;;) {
      std::string_view token = cursor_.lineToken();
      if (token.empty() || token.back() != '\\') return token;
      cursor_.skipLine();
      token.remove_suffix(1);
      if (!token.empty()) return token;
    }
  }

  void skipLogicalLine() {
    if (std::exchange(lineTaken_, false)) return;
    for (;;) {
      const std::string_view rest = cursor_.restOfLine();
      if (rest.empty() || rest.back() != '\\') return;
    }
  }

  void readVertex() {
    glm::dvec3 position(0);
    for (int axis = 0; axis < 3; ++axis) {
      const std::string_view token = lineToken();
      switch (parseNumber(token, position[axis])) {
        case NumberFault::None:
          break;
        case NumberFault::NotANumber:
          cursor_.fail("a coordinate should be here, found {}", quoted(token));
        case NumberFault::NotFinite:
          cursor_.fail("a coordinate is not a finite number: {}", quoted(token));
      }
    }
    builder_.addVertex(position);  // a weight or a colour may follow
  }

  void readFace() {
    const std::size_t place = cursor_.place();
    corners_.clear();
    for (std::string_view token = lineToken(); !token.empty(); token = lineToken()) {
      // v, v/t, v//n or v/t/n; positive numbers count from the first vertex, negative ones back from the last so far.
      std::int64_t number = 0;
      if (!parseInteger(token.substr(0, token.find('/')), number))
        cursor_.fail("a vertex index should be here, found {}", quoted(token));
      if (number == 0) cursor_.fail("vertex index 0: OBJ counts from 1");
      const auto known = static_cast<std::int64_t>(builder_.vertexCount());
      if (number < -known) cursor_.fail("vertex index {} is out of range: {} vertices so far", number, known);
      corners_.push_back(builder_.index(number > 0 ? number - 1 : number + known, place));
    }
    builder_.addFace(corners_, place);
  }

  const Source& source_;
  const ReadMeshOptions& options_;
  TextCursor cursor_;
  SoupBuilder builder_;
  std::vector<std::uint32_t> corners_;
  bool lineTaken_ = false;            // with its end
  Materials materials_;
  bool librariesMissing_ = false;
  std::set<std::string> unknown_;     // materials warned of
};

}  // namespace

// The first keyword decides. A file of nothing but comments is taken for an OBJ without faces.
bool looksLikeObj(const Source& source) {
  TextCursor cursor(source, 0, '#');
  const std::string_view word = cursor.token();
  if (word.empty())
    return std::find(source.data(), source.data() + source.size(), '#') != source.data() + source.size();
  // A lone letter is no mesh: the "p" may be all that is left of a PLY.
  if (cursor.atEnd()) return false;
  return word == "v" || word == "f" || word == "fo" || isOneOf(kPassedOver, word) || isOneOf(kNotRead, word);
}

Mesh readObj(const Source& source, const ReadMeshOptions& options) { return ObjReader(source, options).read(); }

}  // namespace copeel
