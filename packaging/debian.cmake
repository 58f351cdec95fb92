# Debian packages of the components, by CPack: liblamplight0 (the number is the SOVERSION), liblamplight-dev,
# lamplight-tools and, where the window is built, lamplight-view. Build the preset `debian`, then run `cpack -B FOLDER` in
# its build folder.
# SPDX-License-Identifier: Apache-2.0
option(LAMPLIGHT_DEBIAN "Install what Debian packages hold besides, and let cpack make them" OFF)
set(LAMPLIGHT_MAINTAINER "Lamplight maintainers <maintainers@lamplight.invalid>" CACHE STRING
    "Who answers for the Debian packages: NAME <ADDRESS>")
if(NOT LAMPLIGHT_DEBIAN)
  return()
endif()
get_target_property(type lamplight TYPE)
if(NOT type STREQUAL SHARED_LIBRARY OR NOT LAMPLIGHT_TOOLS)
  message(FATAL_ERROR "LAMPLIGHT_DEBIAN needs BUILD_SHARED_LIBS and LAMPLIGHT_TOOLS: use the preset `debian`")
endif()

find_package(Python3 REQUIRED COMPONENTS Interpreter)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/CHANGELOG.md debian/changelog)
execute_process(COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/debian/changelog
                        ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_VERSION} "${LAMPLIGHT_MAINTAINER}"
                OUTPUT_FILE ${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND gzip --best --no-name --force ${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian
                COMMAND_ERROR_IS_FATAL ANY)

set(about "Lamplight finds, on the GPU, which of very many moving lights can reach each
part of a picture, so that shading visits only those.

")
set(runtime liblamplight${LAMPLIGHT_SOVERSION})
set(same_version "(= ${PROJECT_VERSION}-1)")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME ${runtime})
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_CONTROL_EXTRA ${CMAKE_CURRENT_SOURCE_DIR}/debian/triggers)
set(CPACK_DEBIAN_RUNTIME_DESCRIPTION "light culling on the GPU (shared library)
${about}This package contains the library that programs are linked with.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME liblamplight-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${runtime} ${same_version}, libvulkan-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "light culling on the GPU (headers and shaders)
${about}This package contains what programs are built with: headers, the shaders that
theirs include, and files for CMake and pkg-config.")
set(CPACK_DEBIAN_TOOL_PACKAGE_NAME lamplight-tools)
set(CPACK_DEBIAN_TOOL_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_TOOL_PACKAGE_DEPENDS "${runtime} ${same_version}")
set(CPACK_DEBIAN_TOOL_DESCRIPTION "light culling on the GPU (the tool lamp)
${about}This package contains lamp, which renders scenes with many lights, verifies
methods of culling against an oracle, and measures them.")
set(CPACK_DEBIAN_VIEW_PACKAGE_NAME lamplight-view)
set(CPACK_DEBIAN_VIEW_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_VIEW_PACKAGE_DEPENDS "${runtime} ${same_version}")
set(CPACK_DEBIAN_VIEW_DESCRIPTION "light culling on the GPU (the window lamp-view)
${about}This package contains lamp-view, which shows scenes with many lights while they
are culled: which lights are in the cell of a pixel, why, and whether one is
missing.")

set(components runtime development tool)
if(LAMPLIGHT_VIEW)
  list(APPEND components view)
endif()
foreach(component IN LISTS components)
  string(TOUPPER ${component} COMPONENT)
  set(name ${CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME})
  set(documents ${CMAKE_INSTALL_DATADIR}/doc/${name})
  install(FILES debian/copyright ${CMAKE_CURRENT_BINARY_DIR}/changelog.Debian.gz DESTINATION ${documents}
          COMPONENT ${component})
  set(overrides "")
  foreach(of IN ITEMS all ${component})
    set(file ${CMAKE_CURRENT_SOURCE_DIR}/debian/${of}.lintian-overrides)
    if(EXISTS ${file})
      file(READ ${file} text)
      string(APPEND overrides "${text}")
    endif()
  endforeach()
  file(CONFIGURE OUTPUT ${name}.lintian-overrides CONTENT "${overrides}" @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${name}.lintian-overrides
          DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides RENAME ${name} COMPONENT ${component})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_NAME lamplight)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each has its own
set(CPACK_PACKAGE_CONTACT "${LAMPLIGHT_MAINTAINER}")
set(CPACK_COMPONENTS_ALL ${components})
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SOURCE lamplight)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/lib)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
include(CPack)
