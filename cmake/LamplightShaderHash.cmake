# By what SPIR-V of a release is known to be that of the sources beside it.
# SPDX-License-Identifier: Apache-2.0
include_guard()

# A hash over everything that shaders below ROOT may include and their own text.
function(lamplight_shader_hash out source_dir root)
  file(GLOB_RECURSE files LIST_DIRECTORIES OFF RELATIVE ${source_dir}
       ${source_dir}/lib/shaders/* ${source_dir}/lib/include/lamplight/shared/* ${root}/*)
  list(REMOVE_DUPLICATES files)
  list(SORT files)
  set(text "")
  foreach(file IN LISTS files)
    file(SHA256 ${source_dir}/${file} hash)
    string(APPEND text "${file} ${hash}\n")
  endforeach()
  string(SHA256 hash "${text}")
  set(${out} ${hash} PARENT_SCOPE)
endfunction()
