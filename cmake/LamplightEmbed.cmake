# Files and the commit as parts of the binary, so that the tool needs nothing beside it.
# SPDX-License-Identifier: Apache-2.0
include_guard()

# lamplight_embed(TARGET FUNCTION FILE...): adds a source to TARGET that defines
# `std::span<const lamp::app::EmbeddedFile> lamp::app::FUNCTION()`, one row a file, named by the file's name.
function(lamplight_embed target function)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp)
  add_custom_command(
    OUTPUT ${out}
    COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DFUNCTION=${function} "-DFILES=${ARGN}" -P ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/embed_files.cmake
    DEPENDS ${ARGN} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/embed_files.cmake
    COMMENT "Embedding for ${function}()"
    VERBATIM)
  target_sources(${target} PRIVATE ${out})
endfunction()

# lamplight_commit(TARGET): adds a source to TARGET that defines `std::string_view lamp::app::built_from()`: `git describe`
# at every build; "unknown" without git.
function(lamplight_commit target)
  set(out ${CMAKE_CURRENT_BINARY_DIR}/built_from.cpp)
  add_custom_target(${target}_commit
    COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DSOURCE=${PROJECT_SOURCE_DIR} -P ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/describe_commit.cmake
    BYPRODUCTS ${out}
    VERBATIM)
  target_sources(${target} PRIVATE ${out})
  add_dependencies(${target} ${target}_commit)
endfunction()
