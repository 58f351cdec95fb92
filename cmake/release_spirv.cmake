# Adds the folder `spirv` to a source release: SOURCE, the release; BUILD, a build folder of the same sources. SPIR-V
# carries the hash of the shaders it was made of, by which LamplightShaders.cmake knows that it is theirs.
# SPDX-License-Identifier: Apache-2.0
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/LamplightShaderHash.cmake)

set(root_of_library_shaders ${SOURCE}/lib/shaders)
set(root_of_render_shaders ${SOURCE}/app/render/shaders)
foreach(function library_shaders render_shaders)
  set(from ${BUILD}/spirv/${function})
  file(GLOB_RECURSE files RELATIVE ${from} ${from}/*.inc)
  if(NOT files)
    message(FATAL_ERROR "${from}: expected SPIR-V; build lamplight_${function}")
  endif()
  foreach(file IN LISTS files)
    get_filename_component(folder ${file} DIRECTORY)
    file(COPY ${from}/${file} DESTINATION ${SOURCE}/spirv/${function}/${folder})
  endforeach()
  lamplight_shader_hash(hash ${SOURCE} ${root_of_${function}})
  file(WRITE ${SOURCE}/spirv/${function}.sha256 "${hash}\n")
endforeach()
