# Script: cmake -DMODULE=x.so -DOUTPUT=x.hpp -P library_order.cmake
# Writes the names of all libraries that MODULE needs, those that others need first: the loader lists them
# the other way.
# Without ldd the list is short and loading takes longer.
execute_process(COMMAND ldd "${MODULE}" OUTPUT_VARIABLE listed ERROR_QUIET)
string(REGEX MATCHALL "[^ \t\n]+ => /" libraries "${listed}")
list(REVERSE libraries)
set(names "\"libc.so.6\",\n")
foreach(library IN LISTS libraries)
  string(REPLACE " => /" "" library "${library}")
  string(APPEND names "    \"${library}\",\n")
endforeach()
set(code "// Made by cmake/library_order.cmake.\n#pragma once\n\n")
string(APPEND code "inline constexpr const char* CODEC_LIBRARIES[] = {\n    ${names}};\n")
file(WRITE "${OUTPUT}" "${code}")
