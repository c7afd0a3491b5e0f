# The sub-command: options to a picture. Apart from copeel_csg, so that the library needs no command line.
add_library(copeel_csg_command STATIC color_schemes.cpp command.cpp command_options.cpp scad_camera.cpp)
target_link_libraries(copeel_csg_command PUBLIC copeel_command PRIVATE copeel::csg copeel_warnings)
copeel_optimise_less(copeel_csg_command)
copeel_precompile(copeel_csg_command command)
