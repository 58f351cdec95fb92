# GLSL to SPIR-V by glslc, embedded as a table of words. A shader that includes "lookup.glsl" is compiled once for
# every file in lib/shaders/lookup (compute shaders: in lookup/fused too) and is then named "folder/shader@look-up". So is
# a shader in HLSL (NAME.STAGE.hlsl, here "NAME.hlsl") that includes "lookup.hlsl". A shader that itself includes
# "common/depth_image.glsl" is compiled a second time, with MULTISAMPLED, as "folder/shader@multisampled".
# Nothing is compiled, and no glslc is needed, where LAMPLIGHT_SPIRV_FROM or a folder `spirv` beside the sources has it.
# SPDX-License-Identifier: Apache-2.0
include_guard()

set(LAMPLIGHT_SPIRV_FROM "" CACHE PATH "Where to take SPIR-V from instead of compiling it: a build folder of these \
sources, which is brought up to date first, or the folder `spirv` of a source release")
set(LAMPLIGHT_SHADER_INCLUDES ${PROJECT_SOURCE_DIR}/lib/shaders ${PROJECT_SOURCE_DIR}/lib/include)
include(${CMAKE_CURRENT_LIST_DIR}/LamplightShaderHash.cmake)

# What a shader is compiled with, one after the other: look-ups; "-", for nothing; MULTISAMPLED.
function(lamplight_shader_variants out source)
  file(STRINGS ${source} uses_lookup REGEX "^#include \"lookup\\.(glsl|hlsl)\"")
  set(variants "-")
  if(uses_lookup)
    string(REGEX MATCH "glsl|hlsl" language ${uses_lookup})
    file(GLOB variants CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lib/shaders/lookup/*.${language})
    if(source MATCHES "\\.comp$")
      file(GLOB fused CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/lib/shaders/lookup/fused/*.glsl)
      list(APPEND variants ${fused})
    endif()
  endif()
  file(STRINGS ${source} reads_depth REGEX "^#include \"common/depth_image\\.glsl\"")
  if(reads_depth)
    list(APPEND variants MULTISAMPLED)
  endif()
  set(${out} ${variants} PARENT_SCOPE)
endfunction()

# Where the SPIR-V of FUNCTION comes from: `out` is its folder, `out`_kind is COMPILE, BUILD (another build's folder) or
# RELEASE (somebody has compiled it).
function(lamplight_spirv_folder out function root)
  set(from "${LAMPLIGHT_SPIRV_FROM}")
  if(NOT from AND EXISTS ${PROJECT_SOURCE_DIR}/spirv/${function}.sha256)
    set(from ${PROJECT_SOURCE_DIR}/spirv)
  endif()
  set(kind COMPILE)
  set(folder ${PROJECT_BINARY_DIR}/spirv/${function})
  if(EXISTS ${from}/CMakeCache.txt)
    set(kind BUILD)
    set(folder ${from}/spirv/${function})
  elseif(EXISTS ${from}/${function}.sha256)
    lamplight_shader_hash(hash ${PROJECT_SOURCE_DIR} ${root})
    file(STRINGS ${from}/${function}.sha256 released)
    if(hash STREQUAL released)
      set(kind RELEASE)
      set(folder ${from}/${function})
    else()
      message(STATUS "Lamplight: shaders differ from those whose SPIR-V is in ${from}; they are compiled")
    endif()
  elseif(LAMPLIGHT_SPIRV_FROM)
    message(STATUS "Lamplight: ${LAMPLIGHT_SPIRV_FROM} has no SPIR-V of ${function}; it is compiled")
  endif()
  if(kind STREQUAL COMPILE)
    find_program(LAMPLIGHT_GLSLC glslc REQUIRED)
  endif()
  set(${out} ${folder} PARENT_SCOPE)
  set(${out}_kind ${kind} PARENT_SCOPE)
endfunction()

# Compiles a shader into `file`, with `variant`: "-", MULTISAMPLED, or a look-up.
function(lamplight_compile_shader file source root variant)
  set(variant_options "")
  if(variant STREQUAL "MULTISAMPLED")
    set(variant_options -DMULTISAMPLED)
  elseif(NOT variant STREQUAL "-")
    get_filename_component(lookup ${variant} NAME_WE)
    get_filename_component(extension ${variant} EXT)
    file(RELATIVE_PATH include ${PROJECT_SOURCE_DIR}/lib/shaders ${variant})
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/lookup/${lookup}/lookup${extension} CONTENT "#include \"${include}\"\n")
    set(variant_options "-I${PROJECT_BINARY_DIR}/lookup/${lookup}")
  endif()
  set(language --target-env=vulkan1.3)
  if(source MATCHES "\\.(comp|vert|frag)\\.hlsl$")
    # glslc refuses HLSL's storage buffers in the SPIR-V of later targets.
    set(language -x hlsl -fshader-stage=${CMAKE_MATCH_1} --target-env=vulkan1.1)
  endif()
  get_filename_component(folder ${file} DIRECTORY)
  get_filename_component(name ${file} NAME_WLE)
  add_custom_command(
    OUTPUT ${file}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${folder}
    COMMAND ${LAMPLIGHT_GLSLC} ${language} -O -Werror -mfmt=num -MD -MF ${file}.d
            "-I$<JOIN:${LAMPLIGHT_SHADER_INCLUDES};${root},;-I>" ${variant_options} ${source} -o ${file}
    DEPENDS ${source}
    DEPFILE ${file}.d
    COMMENT "Shader ${name}"
    COMMAND_EXPAND_LISTS VERBATIM)
endfunction()

# The target lamplight_FUNCTION, that makes the files `spirv` or lets another build make them.
function(lamplight_spirv_target function kind spirv)
  if(kind STREQUAL BUILD)
    # The terminal is one builder's at a time, so no two build that folder at once.
    add_custom_target(lamplight_${function}
      COMMAND ${CMAKE_COMMAND} --build ${LAMPLIGHT_SPIRV_FROM} --target lamplight_${function}
      BYPRODUCTS ${spirv} USES_TERMINAL COMMENT "SPIR-V of ${function}, from ${LAMPLIGHT_SPIRV_FROM}")
  else()
    add_custom_target(lamplight_${function} DEPENDS ${spirv})
  endif()
endfunction()

# lamplight_shaders(TARGET FUNCTION ROOT): adds a source to TARGET that defines
# `std::span<const lamp::ShaderCode> lamp::FUNCTION()` for all shaders below ROOT.
function(lamplight_shaders target function root)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${root}/*.comp ${root}/*.vert ${root}/*.frag ${root}/*.comp.hlsl
       ${root}/*.vert.hlsl ${root}/*.frag.hlsl)
  list(SORT sources)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${sources})
  lamplight_spirv_folder(spirv_folder ${function} ${root})
  set(declarations "")
  set(rows "")
  set(spirv "")
  set(number 0)
  foreach(source IN LISTS sources)
    file(RELATIVE_PATH source_name ${root} ${source})
    string(REGEX REPLACE "\\.(comp|vert|frag)((\\.hlsl)?)$" "\\2" name ${source_name})
    lamplight_shader_variants(variants ${source})
    foreach(variant IN LISTS variants)
      set(variant_name ${name})
      set(lookup "")
      set(multisampled false)
      if(variant STREQUAL "MULTISAMPLED")
        set(multisampled true)
        set(variant_name "${name}@multisampled")
      elseif(NOT variant STREQUAL "-")
        get_filename_component(lookup ${variant} NAME_WE)
        set(variant_name "${name}@${lookup}")
      endif()
      set(file ${spirv_folder}/${variant_name}.inc)
      if(spirv_folder_kind STREQUAL COMPILE)
        lamplight_compile_shader(${file} ${source} ${root} ${variant})
      endif()
      list(APPEND spirv ${file})
      string(APPEND declarations "const std::uint32_t CODE_${number}[] = {\n#include \"${variant_name}.inc\"\n};\n")
      string(APPEND rows "    {\"${variant_name}\", CODE_${number}, \"${source_name}\", \"${lookup}\", ${multisampled}},\n")
      math(EXPR number "${number} + 1")
    endforeach()
  endforeach()
  set(out ${CMAKE_CURRENT_BINARY_DIR}/${function}.cpp)
  file(CONFIGURE OUTPUT ${out} @ONLY CONTENT
"// Generated by cmake/LamplightShaders.cmake.
#include \"lamplight/shader_code.h\"
#include <array>
#include <cstdint>
namespace {
@declarations@constexpr std::array<lamp::ShaderCode, @number@> TABLE{{
@rows@}};
}
namespace lamp {
std::span<const ShaderCode> @function@() { return TABLE; }
}
")
  lamplight_spirv_target(${function} ${spirv_folder_kind} "${spirv}")
  add_dependencies(${target} lamplight_${function})
  target_sources(${target} PRIVATE ${out})
  set_source_files_properties(${out} PROPERTIES OBJECT_DEPENDS "${spirv}" INCLUDE_DIRECTORIES ${spirv_folder})
endfunction()
