# One interface target carries the warnings, so that installed users do not inherit them.
add_library(copeel_warnings INTERFACE)
target_compile_options(copeel_warnings INTERFACE -Wall -Wextra -Wshadow -Wnon-virtual-dtor
                       $<$<BOOL:${COPEEL_WERROR}>:-Werror>)
