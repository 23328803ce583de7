# brume_texts(HEADER FILES...): the header generated/HEADER with a constant per file, FILE_EXT in capitals, that holds
# its text: what travels inside the program. Configures again when a file changes.
function(brume_texts header)
  set(content "// Made by cmake/embed_texts.cmake.\n#pragma once\n")
  foreach(file IN LISTS ARGN)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${file}")
    cmake_path(GET file FILENAME name)
    string(TOUPPER "${name}" name)
    string(MAKE_C_IDENTIFIER "${name}" name)
    file(READ "${PROJECT_SOURCE_DIR}/${file}" text)
    string(APPEND content "inline constexpr char ${name}[] = R\"text(${text})text\";\n")
  endforeach()
  file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/generated/${header}" CONTENT "@content@" @ONLY)
endfunction()
