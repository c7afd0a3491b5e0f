#include "apps/command/parse_values.h"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "core/error.h"

namespace copeel {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const auto end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

std::optional<double> numberOf(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

// One hexadecimal digit, or -1.
int digitOf(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

void applyLook(MeshArgument& mesh, std::string_view entry) {
  const auto equals = entry.find('=');
  const std::string_view name = trimmed(entry.substr(0, equals));
  const std::string_view value = equals == std::string_view::npos ? std::string_view{} : entry.substr(equals + 1);
  if (name == "color" || name == "colour") {
    mesh.color = parseColor(value, "color");
  } else if (name == "alpha") {
    mesh.alpha = parseAlpha(value, "alpha");
  } else {
    failUsage("a mesh takes color=#rrggbb and alpha=NUMBER, not '{}'", entry);
  }
}

}  // namespace

double parseNumber(std::string_view text, std::string_view option) {
  const std::optional<double> value = numberOf(text);
  if (!value || !std::isfinite(*value)) failUsage("{} takes a finite number, not '{}'", option, text);
  return *value;
}

std::vector<double> parseNumbers(std::string_view text, std::string_view option) {
  std::vector<double> numbers;
  for (const std::string_view part : split(text, ',')) numbers.push_back(parseNumber(part, option));
  return numbers;
}

std::array<int, 2> parseImageSize(std::string_view text) {
  const auto parts = split(text, ',');
  std::array<int, 2> size{};
  bool good = parts.size() == 2;
  for (std::size_t i = 0; good && i < 2; ++i) {
    const std::string_view part = trimmed(parts[i]);
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), size[i]);
    good = !part.empty() && error == std::errc{} && end == part.data() + part.size();
  }
  if (!good) failUsage("--imgsize takes two whole numbers, WIDTH,HEIGHT, not '{}'", text);
  return size;
}

std::array<double, 3> parseColor(std::string_view text, std::string_view option) {
  text = trimmed(text);
  const std::size_t digits = text.size() == 7 ? 2 : 1;   // of each channel
  bool good = (text.size() == 7 || text.size() == 4) && text.front() == '#';
  std::array<double, 3> color{};
  for (std::size_t i = 0; good && i < 3; ++i) {
    const int high = digitOf(text[1 + i * digits]), low = digitOf(text[i * digits + digits]);
    good = high >= 0 && low >= 0;
    color[i] = high * 16 + low;
  }
  if (!good) failUsage("{} takes a colour as '#rrggbb', not '{}'", option, text);
  return color;
}

double parseAlpha(std::string_view text, std::string_view option) {
  const double alpha = parseNumber(text, option);
  if (!(alpha >= 0 && alpha <= 1)) failUsage("{} must be 0 to 1, not {}", option, text);
  return alpha;
}

std::uint64_t parseBytes(std::string_view text, std::string_view option) {
  std::string_view number = trimmed(text);
  double unit = 1;
  if (!number.empty() && (number.back() == 'B' || number.back() == 'b')) number.remove_suffix(1);
  if (!number.empty()) {
    const auto power = std::string_view("kmgt").find(static_cast<char>(number.back() | 0x20));   // 0x20: to lower case
    if (power != std::string_view::npos) {
      unit = std::exp2(10.0 * static_cast<double>(power + 1));
      number.remove_suffix(1);
    }
  }
  const std::optional<double> value = numberOf(number);
  const double bytes = value ? *value * unit : -1;
  if (!(bytes >= 1 && bytes < 0x1p63)) failUsage("{} takes a number of bytes such as 64M or 2G, not '{}'", option, text);
  return static_cast<std::uint64_t>(bytes);
}

Light parseLight(std::string_view text) {
  constexpr double kMostStrength = 1e6;   // far beyond white, and far from where a float ends
  const std::vector<double> numbers = parseNumbers(text, "--light");
  if (numbers.size() != 3 && numbers.size() != 4) failUsage("--light takes X,Y,Z or X,Y,Z,STRENGTH, not '{}'", text);
  const Light light{{numbers[0], numbers[1], numbers[2]}, numbers.size() == 4 ? numbers[3] : 1.0};
  if (light.toward == glm::dvec3(0)) failUsage("--light 0,0,0 is no direction");
  if (!(light.strength >= 0 && light.strength <= kMostStrength)) failUsage("--light takes a strength from 0 to {}, not {}", kMostStrength, light.strength);
  return light;
}

bool parseProjection(std::string_view text) {
  if (text == "p" || text == "persp" || text == "perspective") return true;
  if (text == "o" || text == "ortho" || text == "orthogonal" || text == "orthographic") return false;
  failUsage("--projection takes 'o' (ortho) or 'p' (perspective), not '{}'", text);
}

MeshArgument parseMeshArgument(const std::string& text) {
  const auto colon = text.rfind(':');
  const std::string_view look = colon == std::string::npos ? std::string_view{} : std::string_view(text).substr(colon + 1);
  const bool hasLook = look.starts_with("color=") || look.starts_with("colour=") || look.starts_with("alpha=");
  std::error_code ignored;
  if (!hasLook || std::filesystem::exists(text, ignored)) return {text, {}, {}};
  MeshArgument mesh{text.substr(0, colon), {}, {}};
  for (const std::string_view entry : split(look, ',')) applyLook(mesh, entry);
  return mesh;
}

}  // namespace copeel
