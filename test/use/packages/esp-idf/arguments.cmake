# SPDX-License-Identifier: MIT
# The words that ESP-IDF's idf_component_register knows, as component_...
macro(component_arguments)
  cmake_parse_arguments(
    component "WHOLE_ARCHIVE" "KCONFIG;KCONFIG_PROJBUILD"
    "SRCS;SRC_DIRS;EXCLUDE_SRCS;INCLUDE_DIRS;PRIV_INCLUDE_DIRS;LDFRAGMENTS;\
REQUIRES;PRIV_REQUIRES;REQUIRED_IDF_TARGETS;EMBED_FILES;EMBED_TXTFILES" ${ARGN})
  if(component_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "unknown: ${component_UNPARSED_ARGUMENTS}")
  endif()
endmacro()
