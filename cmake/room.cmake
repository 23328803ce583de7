# brume_room(NAME [APART] [CALM] [LINKS rooms...] [LIBRARIES targets...]): the static library brume_NAME of
# host/NAME/**.cpp. LINKS are seen by everyone who links the room, LIBRARIES only by the room itself.
# APART: its files use the same names, so that they cannot be compiled together. CALM: it spends no time itself. Both:
# defaults.cmake.
# A room of headers alone becomes an INTERFACE library.
add_library(brume_roots INTERFACE)
target_include_directories(brume_roots INTERFACE "${PROJECT_SOURCE_DIR}/host" "${PROJECT_SOURCE_DIR}/kernels"
                                                 "${PROJECT_BINARY_DIR}/generated")
target_link_libraries(brume_roots INTERFACE glm::glm)

function(brume_room name)
  cmake_parse_arguments(PARSE_ARGV 1 room "APART;CALM" "" "LINKS;LIBRARIES")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/host/${name}/*.cpp")
  list(TRANSFORM room_LINKS PREPEND brume_)
  if(sources)
    add_library(brume_${name} STATIC ${sources})
    target_link_libraries(brume_${name} PUBLIC brume_roots ${room_LINKS} PRIVATE ${room_LIBRARIES})
    if(NOT room_APART)
      brume_join(brume_${name})
    endif()
    if(room_CALM)
      brume_calm(brume_${name})
    endif()
  else()
    add_library(brume_${name} INTERFACE)
    target_link_libraries(brume_${name} INTERFACE brume_roots ${room_LINKS})
  endif()
endfunction()

# brume_exports(PROGRAM): its own functions come before those of drivers' libraries.
function(brume_exports program)
  set(exported "${PROJECT_SOURCE_DIR}/cmake/exported_symbols.list")
  target_link_options(${program} PRIVATE "-Wl,--dynamic-list=${exported}")
  set_property(TARGET ${program} APPEND PROPERTY LINK_DEPENDS "${exported}")
endfunction()
