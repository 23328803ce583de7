# Script: cmake -DROOT=kernels -DFILES=a;b -DOUTPUT=x.cpp -P embed_kernels.cmake
# Writes the table {path relative to ROOT, text} of kernel_text.hpp as one C++ file.
set(LITERAL_MAX 16000) # bytes; compilers need not take longer literals. Adjacent ones become one string.

function(literals_append text)
  string(LENGTH "${text}" length)
  while(length GREATER LITERAL_MAX)
    string(SUBSTRING "${text}" 0 ${LITERAL_MAX} head)
    string(FIND "${head}" "\n" cut REVERSE) # whole lines only: a cut never lands inside a UTF-8 character
    math(EXPR cut "${cut} + 1")
    string(SUBSTRING "${text}" 0 ${cut} head)
    string(SUBSTRING "${text}" ${cut} -1 text)
    string(APPEND code "\n     R\"brume(${head})brume\"")
    string(LENGTH "${text}" length)
  endwhile()
  string(APPEND code "\n     R\"brume(${text})brume\"")
  set(code "${code}" PARENT_SCOPE)
endfunction()

set(code "// Made by cmake/embed_kernels.cmake from kernels/.\n#include \"cl/kernel_text.hpp\"\n\n")
string(APPEND code "namespace brume {\n\n")
string(APPEND code "const std::vector<KernelFile>& kernel_files() {\n  static const std::vector<KernelFile> files{\n")
foreach(path IN LISTS FILES)
  file(READ "${ROOT}/${path}" text)
  string(APPEND code "    {\"${path}\",")
  literals_append("${text}")
  string(APPEND code "},\n")
endforeach()
string(APPEND code "  };\n  return files;\n}\n\n}  // namespace brume\n")
file(WRITE "${OUTPUT}" "${code}")
