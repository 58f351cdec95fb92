# The target Vulkan::Headers. CMake's find_package(Vulkan) makes it, but only where there is a loader to link as well;
# where there is none, it is of the headers that this has found.
# SPDX-License-Identifier: Apache-2.0
find_package(Vulkan QUIET ${LAMPLIGHT_VULKAN_GLOBAL})
if(NOT TARGET Vulkan::Headers AND Vulkan_INCLUDE_DIR)
  add_library(Vulkan::Headers INTERFACE IMPORTED ${LAMPLIGHT_VULKAN_GLOBAL})
  set_target_properties(Vulkan::Headers PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${Vulkan_INCLUDE_DIR}")
endif()
