# Files to models.
find_package(PkgConfig REQUIRED)
pkg_check_modules(POLYCLIPPING REQUIRED IMPORTED_TARGET polyclipping)
pkg_check_modules(GMPXX REQUIRED IMPORTED_TARGET gmpxx)
target_link_libraries(copeel_csg PRIVATE PkgConfig::POLYCLIPPING PkgConfig::GMPXX)
target_sources(copeel_csg PRIVATE
  arguments.cpp color_names.cpp csg_parser.cpp csg_scanner.cpp csg_syntax.cpp degrees.cpp delaunay.cpp evaluate.cpp external.cpp
  extrude.cpp flat.cpp named_pipe.cpp openscad_log.cpp orientation.cpp polyhedron.cpp process.cpp read_csg.cpp read_meshes.cpp restore_matrix.cpp
  scad_export.cpp shapes.cpp solids.cpp triangulate.cpp)
