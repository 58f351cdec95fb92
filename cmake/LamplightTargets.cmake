# What every target of the project has in common: language level, warnings, sanitizers.
# SPDX-License-Identifier: Apache-2.0
include_guard()

set(LAMPLIGHT_JOIN "" CACHE STRING "What to compile several files at once: nothing, tests, tools (all but the library) or \
all. Quicker from scratch, slower after a change; hides a missing #include; needs Python")
set_property(CACHE LAMPLIGHT_JOIN PROPERTY STRINGS "" tests tools all)
if(LAMPLIGHT_JOIN)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
endif()

function(lamplight_configure target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON)
  # What checks lights looks for NaN, and a range may be infinite: where the project around has -ffast-math or a part of
  # it, this takes it back. Fused multiply-adds may stay: they round less than what bounds allow for.
  target_compile_options(${target} PRIVATE $<IF:$<BOOL:${MSVC}>,/fp:precise,-fno-fast-math>)
  if(MSVC)
    # Sources are UTF-8; members of classes that a DLL exports may be of std (C4251).
    target_compile_options(${target} PRIVATE /utf-8 /permissive- /wd4251)
    if(PROJECT_IS_TOP_LEVEL)
      target_compile_options(${target} PRIVATE /W4)
    endif()
  elseif(PROJECT_IS_TOP_LEVEL)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                             -Wno-missing-field-initializers)
    # Errors in the builds that have the tests. A release build has to work with compilers that nobody here has tried;
    # at -O3, g++ 12 sees overlaps in `"text" + std::string` that are not there (GCC bug 105651).
    if(LAMPLIGHT_TESTS)
      target_compile_options(${target} PRIVATE -Werror)
    elseif(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
      target_compile_options(${target} PRIVATE -Wno-restrict)
    endif()
    if(LAMPLIGHT_SANITIZE)
      # g++ 12 takes parts of its own <regex> for uninitialized once they are instrumented.
      target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
      target_compile_options(${target} PRIVATE -fsanitize=${LAMPLIGHT_SANITIZE} -fno-sanitize-recover=all
                                               -fno-omit-frame-pointer)
      target_link_options(${target} PUBLIC -fsanitize=${LAMPLIGHT_SANITIZE})
    endif()
  endif()
endfunction()

# For targets that the tests spend much of their time in: -O2 where a preset says -O1, which inlines no small functions.
function(lamplight_optimise target)
  if(PROJECT_IS_TOP_LEVEL AND NOT MSVC)
    target_compile_options(${target} PRIVATE $<$<CONFIG:RelWithDebInfo>:-O2>)
  endif()
endfunction()

# For tests, which no fuzzer runs: without what shows fuzzers their way, which takes a seventh of the time to compile.
function(lamplight_without_fuzzers target)
  if(PROJECT_IS_TOP_LEVEL AND LAMPLIGHT_SANITIZE MATCHES fuzzer)
    target_compile_options(${target} PRIVATE -fno-sanitize=fuzzer-no-link)
  endif()
endfunction()

# Compiles the target's sources in groups, if LAMPLIGHT_JOIN is one of those named.
function(lamplight_join target)
  if(NOT LAMPLIGHT_JOIN IN_LIST ARGN)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  execute_process(COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/joint_sources.py ${sources}
                  OUTPUT_VARIABLE lines COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" lines "${lines}")
  foreach(line IN LISTS lines)
    string(REGEX MATCH "^([0-9]+) (.+)$" match ${line})
    set_source_files_properties(${CMAKE_MATCH_2} PROPERTIES UNITY_GROUP ${CMAKE_MATCH_1})
    # The group follows from what the file defines.
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_MATCH_2})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  # A name may be another file's; and g++ takes what is included for a header, which other files might include too.
  if(NOT MSVC)
    target_compile_options(${target} PRIVATE -Wno-shadow $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endif()
endfunction()

# lamplight_precompile(TARGET HEADER...): precompiles headers of others, which take most of the time of a build; our own
# headers stay out, so that a change rebuilds only what includes it. Every file still includes what it uses.
function(lamplight_precompile target)
  if(PROJECT_IS_TOP_LEVEL)
    target_precompile_headers(${target} PRIVATE
      <algorithm> <array> <cmath> <filesystem> <fmt/format.h> <functional> <glm/glm.hpp> <map> <memory> <optional> <random>
      <set> <span> <string> <vector> ${ARGN})
  endif()
endfunction()

# Of files that do the same for one system or another, NAME_posix.cpp and NAME_windows.cpp, leaves this system's in a list.
function(lamplight_of_this_system list)
  set(other_system windows)
  if(WIN32)
    set(other_system posix)
  endif()
  list(FILTER ${list} EXCLUDE REGEX "_${other_system}(_test)?\\.cpp$")
  set(${list} ${${list}} PARENT_SCOPE)
endfunction()

# A static library from every .cpp in a folder, so that a new file needs no line here.
function(lamplight_library target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "FOLDERS;LINK")
  set(sources)
  foreach(folder IN LISTS arg_FOLDERS)
    file(GLOB found CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
    list(APPEND sources ${found})
  endforeach()
  lamplight_of_this_system(sources)
  add_library(${target} STATIC ${sources})
  lamplight_configure(${target})
  lamplight_join(${target} tools all)
  target_link_libraries(${target} PUBLIC ${arg_LINK})
endfunction()
