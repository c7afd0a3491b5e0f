find_package(TBB REQUIRED)
target_sources(copeel_csg PRIVATE
  bounds.cpp
  csg_fold.cpp
  eye_winding.cpp
  gates.cpp
  look.cpp
  render_csg.cpp
)
target_link_libraries(copeel_csg PRIVATE TBB::tbb)
if(COPEEL_GL)
  target_sources(copeel_csg PRIVATE gl_pass.cpp)
endif()
