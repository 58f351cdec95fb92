# Compiles the consumer's shader, which includes a look-up.
# SPDX-License-Identifier: Apache-2.0
find_program(GLSLC glslc REQUIRED)
add_custom_command(OUTPUT consumer.inc
  COMMAND ${GLSLC} --target-env=vulkan1.3 -mfmt=num "-I$<JOIN:${LAMPLIGHT_SHADER_INCLUDE_DIRS},;-I>"
          ${CMAKE_CURRENT_LIST_DIR}/consumer.comp -o consumer.inc
  DEPENDS ${CMAKE_CURRENT_LIST_DIR}/consumer.comp
  COMMAND_EXPAND_LISTS VERBATIM)
target_sources(consumer PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/consumer.inc)
target_include_directories(consumer PRIVATE ${CMAKE_CURRENT_BINARY_DIR})
