// copeel oit: transparent meshes to a picture.
#pragma once

namespace CLI {
class App;
}

namespace copeel::oit {

// Declares the sub-command; it runs, and throws copeel::Error, while `program` parses the command line.
void addCommand(CLI::App& program);

}  // namespace copeel::oit
