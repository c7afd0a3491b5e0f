// MTL (Wavefront): the colours of an OBJ's materials. Of a material, Kd is its colour and d (or Tr = 1 - d) its opacity, 1 where the file says
// nothing; textures and all that shines are passed over. Values beyond 0 … 1 are brought to it.
#pragma once

#include <map>
#include <string>

#include <glm/vec4.hpp>

#include "core/formats/input_file.h"
#include "core/formats/text_cursor.h"

namespace copeel {

using Materials = std::map<std::string, glm::vec4>;   // as in Mesh::colors

// What is left of the line, without the blanks around it: names of materials and libraries may have blanks within. Skips the line's end.
std::string restAsName(TextCursor& cursor);

// Throws Error{Input} on numbers that are none.
void readMtl(const Source& source, Materials& materials);

// Reads the library that an OBJ names, which lies relative to it. False when there is no such file.
bool addMaterials(const std::string& objPath, const std::string& library, Materials& materials);

}  // namespace copeel
