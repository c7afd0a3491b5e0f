// One function per format, over bytes in memory; OFF and STL give no colours. Each throws Error{Input} on anything that is not a whole, sound file of its format.
#pragma once

#include "core/formats/input_file.h"
#include "core/formats/read_mesh.h"
#include "core/scene/mesh.h"

namespace copeel {

Mesh readObj(const Source& source, const ReadMeshOptions& options);
Mesh readOff(const Source& source, const ReadMeshOptions& options);
Mesh readPly(const Source& source, const ReadMeshOptions& options);
Mesh readStl(const Source& source, const ReadMeshOptions& options);  // ascii or binary

// What a first look at the bytes says; readMesh asks in this order. At most one is true of a sound file.
bool looksLikePly(const Source& source);
bool looksLikeStl(const Source& source);
bool looksLikeOff(const Source& source);
bool looksLikeObj(const Source& source);

}  // namespace copeel
