// Mesh files to triangle soups: OBJ, OFF, PLY (ascii and binary), STL (ascii and binary). The content decides the format, not the name.
// Every face of the file is in the result; polygons are cut into triangles of one facet. Double precision is kept where the file has it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/scene/mesh.h"

namespace copeel {

// What is wanted beside the geometry.
struct ReadMeshOptions {
  // Keep the colours of the file (Mesh::colors): OBJ's materials (Kd, d or Tr, from the .mtl beside it), PLY's of faces or, as the mean of a
  // face's corners, of vertices.
  bool colors = false;
  std::vector<std::string>* warnings = nullptr;   // receives a line for each colour that could not be had, such as a missing .mtl
};

// Throws Error{Input} with one line naming file, line (or byte) and cause.
Mesh readMesh(const std::string& path, const ReadMeshOptions& options = {});
// The same of bytes in memory; the name is for messages, and for where a .mtl lies.
Mesh readMeshFromMemory(std::span<const char> bytes, const std::string& name, const ReadMeshOptions& options = {});

// What is notable about a mesh, found and reported, never repaired. Counts are exact.
struct MeshStatus {
  std::uint64_t triangleCount = 0;
  std::uint64_t boundaryEdgeCount = 0;          // edges with one face: the mesh is not closed
  std::uint64_t nonManifoldEdgeCount = 0;       // edges with more than two faces
  std::uint64_t inconsistentEdgeCount = 0;      // two faces that run along the edge in the same direction
  std::uint64_t degenerateTriangleCount = 0;    // zero area
  std::uint64_t duplicateTriangleCount = 0;     // same three positions as an earlier one, either orientation
  std::uint64_t unreferencedVertexCount = 0;
  bool closed = false;                          // every directed edge is met by as many opposite ones: the winding number is sound
  bool insideOut = false;                       // closed with negative volume

  std::string summary() const;                  // one line of named reasons; empty when there is nothing to say
};

// Edges are compared by exact position, so that a soup without shared vertices can be closed. O(n log n) or better.
MeshStatus statusOf(const Mesh& mesh);

}  // namespace copeel
