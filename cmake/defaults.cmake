# What every target gets: the standard, an optimised build unless told otherwise, warnings, ccache where there is one.
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, RelWithDebInfo or Debug" FORCE)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
add_compile_options(-Wall -Wextra -Wshadow -Wswitch-enum)

# Half of the compiler's work is reading headers, most of all those of the libraries: the files of a room are compiled
# together, so that they read them once, and tests precompile them. OFF compiles each file by itself, which finds an
# include
# that a file needs and has only from a neighbour.
option(BRUME_JOIN_FILES "Compile the files of a room together and precompile the headers of tests" ON)

function(brume_join target)
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${BRUME_JOIN_FILES} UNITY_BUILD_BATCH_SIZE 16)
endfunction()

# The other half is optimising what the headers of the libraries make: less of that where no time is spent at run time.
function(brume_calm target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# Paths relative to the sources, so that a second clone finds what the first one compiled.
find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env "CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}" CCACHE_NOHASHDIR=1
      CCACHE_SLOPPINESS=pch_defines,time_macros "${CCACHE}") # it knows a precompiled header by its text then
endif()
