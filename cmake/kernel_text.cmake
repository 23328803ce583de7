# brume_kernel_text(TARGET): compiles the text of every file in kernels/ into TARGET, see host/cl/kernel_text.hpp.
# Runs again when a kernel file changes, comes or goes: the list is part of the command.
function(brume_kernel_text target)
  set(root "${PROJECT_SOURCE_DIR}/kernels")
  set(script "${PROJECT_SOURCE_DIR}/cmake/embed_kernels.cmake")
  set(output "${PROJECT_BINARY_DIR}/generated/kernel_text.cpp")
  file(GLOB_RECURSE files RELATIVE "${root}" CONFIGURE_DEPENDS "${root}/*.h" "${root}/*.cl")
  list(TRANSFORM files PREPEND "${root}/" OUTPUT_VARIABLE inputs)
  add_custom_command(
    OUTPUT "${output}"
    COMMAND "${CMAKE_COMMAND}" "-DROOT=${root}" "-DFILES=${files}" "-DOUTPUT=${output}" -P "${script}"
    DEPENDS ${inputs} "${script}"
    COMMENT "Embedding the kernels"
    VERBATIM)
  target_sources(${target} PRIVATE "${output}")
endfunction()
