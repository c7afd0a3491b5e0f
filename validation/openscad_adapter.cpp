#include "validation/openscad_adapter.h"

#include <filesystem>
#include <fstream>

#include "apps/csg/process.h"
#include "core/error.h"
#include "core/formats/read_mesh.h"
#include "core/image/write_image.h"

namespace copeel::validation {
namespace {

// Runs openscad on a text with the output's name last; true when it ended well and wrote the output.
bool runOpenscad(const csg::TemporaryFolder& folder, const std::string& text, const std::string& output, std::vector<std::string> arguments) {
  const std::string input = folder.path() + "/scene.scad";
  std::ofstream(input, std::ios::binary) << text;
  arguments.insert(arguments.end(), {"-o", output, input});
  std::vector<csg::Command> commands{{arguments, folder.path() + "/log", -1}};
  csg::runAll(commands, 1);
  return commands[0].exitCode == 0 && std::filesystem::exists(output);
}

std::string temporaryPlace() { return std::filesystem::temp_directory_path().string(); }

}  // namespace

bool openscadIsHere() {
  try {
    const csg::TemporaryFolder folder(temporaryPlace());
    std::vector<csg::Command> commands{{{"openscad", "--version"}, folder.path() + "/log", -1}, {{"xvfb-run", "--help"}, folder.path() + "/log2", -1}};
    csg::runAll(commands, 1);
    return commands[0].exitCode == 0 && commands[1].exitCode == 0;
  } catch (const Error&) {
    return false;
  }
}

std::optional<Image<Rgb8>> openscadPreview(const std::string& text, const std::vector<std::string>& options) {
  const csg::TemporaryFolder folder(temporaryPlace());
  const std::string output = folder.path() + "/preview.png";
  std::vector<std::string> arguments{"xvfb-run", "-a", "openscad", "--preview"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  if (!runOpenscad(folder, text, output, arguments)) return std::nullopt;
  return readPng(output);
}

std::optional<Mesh> openscadRender(const std::string& text) {
  const csg::TemporaryFolder folder(temporaryPlace());
  const std::string output = folder.path() + "/render.off";
  if (!runOpenscad(folder, text, output, {"openscad"})) return std::nullopt;
  return readMesh(output);
}

}  // namespace copeel::validation
