// A shape's cache entry is the binary STL that openscad wrote, the format that keeps most: 24 bits of each coordinate, where its text formats
// keep six digits. A flat shape is drawn up by 1 first; its coordinates lie on openscad's grid of 2^-16 and so come through unchanged up to
// 256 units. The name of an entry is a hash of the subtree's text, of the contents of the files it names and of the openscad program itself.
#include "apps/csg/external.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "apps/csg/content_hash.h"
#include "apps/csg/flat.h"
#include "apps/csg/openscad_log.h"
#include "apps/csg/process.h"
#include "apps/csg/shapes.h"
#include "core/error.h"
#include "core/formats/input_file.h"
#include "core/output_file.h"

namespace copeel::csg {
namespace {

namespace fs = std::filesystem;

std::string quotedForOpenscad(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n') result += "\\n";
    else if (c == '\t') result += "\\t";
    else if (c == '\r') result += "\\r";
    else result += c;
  }
  return result + '"';
}

std::string absolutePath(const std::string& folder, const std::string& file) {
  return fs::absolute(fs::path(folder.empty() ? "." : folder) / file).lexically_normal().string();
}

// Where the files of a program are looked up: as posix_spawnp does.
std::string findProgram(const std::string& name) {
  if (name.find('/') != std::string::npos) return name;
  const char* path = std::getenv("PATH");
  std::string folders = path ? path : "/usr/bin:/bin";
  for (std::size_t begin = 0; begin <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', begin), folders.size());
    const std::string candidate = (fs::path(folders.substr(begin, end - begin)) / name).string();
    std::error_code error;
    if (fs::is_regular_file(candidate, error)) return candidate;
    begin = end + 1;
  }
  return "";
}

// The program's file tells its versions apart without running it.
std::string identityOf(const std::string& openscad) {
  const std::string program = findProgram(openscad);
  std::error_code error;
  const auto size = fs::file_size(program, error);
  if (program.empty() || error) failMachine("{}: not found; the program openscad is needed for parts of this model", openscad);
  return fmt::format("{} {}", size, fs::last_write_time(program, error).time_since_epoch().count());
}

// A subtree written anew: strings escaped, files by their full path, without time stamps, which openscad writes but does not know.
struct Writer {
  const SyntaxTree& tree;
  const std::string& folder;
  std::string text;
  ContentHash hash;

  void write(std::uint32_t root) {
    const SyntaxNode& first = tree.nodes[root];
    std::size_t copied = first.textBegin;
    for (std::uint32_t i = root; i < first.subtreeEnd; ++i) {
      const SyntaxNode& node = tree.nodes[i];
      for (std::uint32_t a = 0; a < node.argumentCount; ++a) {
        const Argument& argument = tree.arguments[node.firstArgument + a];
        const Value& value = tree.tape[argument.value];
        const std::string_view name = tree.text.substr(argument.nameBegin, argument.nameLength);
        if (name == "timestamp" && a > 0) {
          copy(copied, tree.text.rfind(',', argument.nameBegin));
          copied = value.textBegin + value.textLength();
        }
        if (value.kind == ValueKind::String) replaceString(copied, name, value);
      }
    }
    copy(copied, first.textEnd);
  }

  void replaceString(std::size_t& copied, std::string_view name, const Value& value) {
    std::string content = tree.stringOf(value);
    // The key holds a file's bytes, the text its place.
    const bool isFile = name == "file" && !content.empty();
    if (isFile) content = absolutePath(folder, content);
    copy(copied, value.textBegin - 1u);
    text += quotedForOpenscad(content);
    copied = value.textBegin + value.textLength() + 1u;
    if (isFile) addFile(content, value.textBegin);
    else hash.add(content);
  }

  void addFile(const std::string& path, std::size_t place) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) tree.fail(place, fmt::format("{}: no such file", path));
    const InputFile file(path);
    const Source source = file.source();
    hash.add(fs::path(path).extension().string());
    hash.add({source.data(), source.size()});
  }

  void copy(std::size_t& copied, std::size_t end) {
    const std::string_view part = tree.text.substr(copied, end - copied);
    text += part;
    hash.addDense(part);   // white space depends on the depth of nesting only
    copied = end;
  }
};

struct Job {
  std::vector<std::uint32_t> nodes;    // subtrees of the same content
  bool flat = false;
  std::string text;
  std::string key;
};

// The subtrees that only openscad evaluates: the outermost ones, and within those what carries % or # and is shown by itself.
std::vector<std::uint32_t> externalRoots(const SyntaxTree& tree) {
  struct Range {
    std::uint32_t end;
    bool isEvaluated;     // as part of a root
  };
  std::vector<std::uint32_t> roots;
  std::vector<Range> ranges{{static_cast<std::uint32_t>(tree.nodes.size()), false}};
  for (std::uint32_t i = 0; i < tree.nodes.size();) {
    const SyntaxNode& node = tree.nodes[i];
    while (i >= ranges.back().end) ranges.pop_back();
    if (node.modifiers & kDisabled) {
      i = node.subtreeEnd;
      continue;
    }
    // Two ranges for each shape around this one.
    const bool isShown = node.modifiers & (kBackground | kHighlight) && ranges.size() < 2 * kMostShapesWithinShapes;
    if (ranges.back().isEvaluated && isShown) ranges.push_back({node.subtreeEnd, false});
    if (!ranges.back().isEvaluated && isExternalNode(tree, i)) {
      roots.push_back(i);
      ranges.push_back({node.subtreeEnd, true});
    }
    const bool hidesMarks = !isTreeKeyword(node.keyword) && !showsMarksWithin(node.keyword);
    i = ranges.back().isEvaluated && hidesMarks ? node.subtreeEnd : i + 1;
  }
  return roots;
}

std::string keyFolder(const std::string& wanted) {
  fs::path folder = wanted;
  if (folder.empty()) {
    const char* cache = std::getenv("XDG_CACHE_HOME");
    const char* home = std::getenv("HOME");
    if (cache && *cache == '/') folder = fs::path(cache) / "copeel";
    else if (home && *home) folder = fs::path(home) / ".cache" / "copeel";
  }
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  // Where no cache can be, the shapes are evaluated each time.
  const bool usable = !folder.empty() && !error;
  return usable ? folder.string() : "";
}

struct FloatKey {
  std::array<std::uint32_t, 3> bits;
  bool operator==(const FloatKey&) const = default;
};

struct FloatKeyHash {
  std::size_t operator()(const FloatKey& key) const {
    return (key.bits[0] * 0x9E3779B97F4A7C15u) ^ (key.bits[1] * 0xC2B2AE3D27D4EB4Fu) ^ (std::uint64_t{key.bits[2]} << 29);
  }
};

// The shortest decimal that gives the same float is what a person has written more often than not: 0.1, not 0.100000001490116.
double shortestDecimal(float value) {
  char text[32];
  const auto printed = std::to_chars(text, text + sizeof(text), value);
  double result = value;
  std::from_chars(text, printed.ptr, result);
  return result;
}

constexpr std::size_t kStlHeadBytes = 84, kStlTriangleBytes = 50;

// A null mesh where the file holds no triangle, nothing where it is no whole binary STL.
std::optional<MeshPointer> readStl(const std::string& path, bool flat) {
  const InputFile file(path);
  const Source source = file.source();
  std::uint32_t count = 0;
  if (source.size() < kStlHeadBytes) return std::nullopt;
  std::memcpy(&count, source.data() + kStlHeadBytes - 4, 4);
  if (source.size() != kStlHeadBytes + kStlTriangleBytes * count) return std::nullopt;
  Mesh mesh;
  mesh.singlePrecision = !flat;
  std::unordered_map<FloatKey, std::uint32_t, FloatKeyHash> known;
  for (std::uint32_t t = 0; t < count; ++t) {
    glm::uvec3 triangle;
    for (int corner = 0; corner < 3; ++corner) {
      std::array<float, 3> p;
      std::memcpy(p.data(), source.data() + kStlHeadBytes + kStlTriangleBytes * t + 12 + 12 * static_cast<std::size_t>(corner), 12);
      for (float& x : p) x += 0.0f;   // -0 becomes 0
      FloatKey key;
      std::memcpy(key.bits.data(), p.data(), 12);
      const auto [found, isNew] = known.emplace(key, static_cast<std::uint32_t>(mesh.vertices.size()));
      if (isNew && flat) mesh.vertices.emplace_back(p[0], p[1], p[2]);
      if (isNew && !flat) mesh.vertices.emplace_back(shortestDecimal(p[0]), shortestDecimal(p[1]), shortestDecimal(p[2]));
      triangle[corner] = found->second;
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh.triangles.empty() ? nullptr : std::make_shared<const Mesh>(std::move(mesh));
}

// openscad writes nan and inf but reads them as names of variables: so they are made variables.
std::string scadText(const Job& job) {
  const std::string names = "nan = 0 / 0;\ninf = 1 / 0;\n";
  return names + (job.flat ? "linear_extrude(height = 1) {\n" + job.text + "\n}\n" : job.text + "\n");
}

class Batch {
 public:
  Batch(const SyntaxTree& tree, const ReadOptions& options, ExternalShapes& result)
      : tree_(tree), options_(options), result_(result), cache_(keyFolder(options.cacheFolder)),
        temporary_(cache_.empty() ? systemTemporaryFolder() : cache_) {}

  void run(std::vector<Job>& jobs) {
    std::vector<Job*> missing;
    for (Job& job : jobs) {
      if (!take(job, entryPath(job))) missing.push_back(&job);
    }
    std::vector<Command> commands;
    for (const Job* job : missing) commands.push_back(commandFor(*job));
    runAll(commands, std::max(std::thread::hardware_concurrency(), 2u));
    for (std::size_t i = 0; i < missing.size(); ++i) finish(*missing[i], commands[i]);
  }

 private:
  std::string entryPath(const Job& job) const { return (fs::path(cache_) / (job.key + ".stl")).string(); }
  std::string workPath(const Job& job, const char* extension) const { return (fs::path(temporary_.path()) / (job.key + extension)).string(); }

  bool take(const Job& job, const std::string& path) {
    std::error_code error;
    return !cache_.empty() && fs::is_regular_file(path, error) && give(job, path);
  }

  // False where the file is damaged.
  bool give(const Job& job, const std::string& path) {
    const std::optional<MeshPointer> mesh = readStl(path, job.flat);
    if (!mesh) return false;
    for (const std::uint32_t node : job.nodes) result_.shapes[node] = {job.flat, *mesh};
    return true;
  }

  Command commandFor(const Job& job) const {
    writeFile(workPath(job, ".scad"), scadText(job));
    Command command;
    command.arguments = {options_.openscad, "--export-format", "binstl", "-o", workPath(job, ".stl"), workPath(job, ".scad")};
    command.logPath = workPath(job, ".log");
    return command;
  }

  void finish(const Job& job, const Command& command) {
    const SyntaxNode& node = tree_.nodes[job.nodes.front()];
    const std::string place = fmt::format("{}:{}", tree_.name, tree_.lineAt(node.textBegin));
    const std::string who = fmt::format("{}: openscad on {}", place, tree_.nameOf(node));
    const OpenscadLog log = readOpenscadLog(command.logPath, workPath(job, ".scad"), who, SourceLines::Meaningless);
    result_.warnings.insert(result_.warnings.end(), log.warnings.begin(), log.warnings.end());
    const std::string made = workPath(job, ".stl");
    std::error_code error;
    const bool exists = fs::is_regular_file(made, error);
    if (!exists && log.emptyObject) {
      writeFile(made, std::string(kStlHeadBytes, '\0'));
    } else if (command.exitCode != 0 || !exists) {
      if (!log.errors.empty()) throw Error(ExitCode::Input, log.errors.front());
      failMachine("{} failed with code {}", who, command.exitCode);
    }
    if (!give(job, made)) failMachine("{} wrote no whole mesh", who);
    // A rename is atomic: another Copeel finds the whole entry or none.
    if (!cache_.empty()) fs::rename(made, entryPath(job), error);
  }

  const SyntaxTree& tree_;
  const ReadOptions& options_;
  ExternalShapes& result_;
  std::string cache_;
  TemporaryFolder temporary_;
};

}  // namespace

ExternalShapes evaluateExternal(const SyntaxTree& tree, const std::string& folder, const ReadOptions& options) {
  ExternalShapes result;
  const std::vector<std::uint32_t> roots = externalRoots(tree);
  if (roots.empty()) return result;
  const std::string identity = identityOf(options.openscad);
  const std::vector<std::uint8_t> dimensions = dimensionsOf(tree);
  std::vector<Job> jobs;
  std::unordered_map<std::string, std::size_t> byKey;
  for (const std::uint32_t root : roots) {
    Job job;
    job.flat = dimensions[root] == 2;
    Writer writer{tree, folder, {}, {}};
    writer.hash.add(identity);
    writer.hash.add(job.flat ? "flat" : "solid");
    writer.write(root);
    job.text = std::move(writer.text);
    job.key = writer.hash.hex();
    const auto [found, isNew] = byKey.emplace(job.key, jobs.size());
    if (isNew) jobs.push_back(std::move(job));
    jobs[found->second].nodes.push_back(root);
  }
  Batch(tree, options, result).run(jobs);
  return result;
}

}  // namespace copeel::csg
