# SPDX-License-Identifier: MIT
# vcpkg's functions that a port calls, done with plain CMake for one build. -DPORT is
# the port's folder, -DPREFIX where the package goes.
set(CURRENT_PACKAGES_DIR ${PREFIX})

function(vcpkg_check_linkage linkage)
  if(NOT linkage STREQUAL ONLY_STATIC_LIBRARY)
    message(FATAL_ERROR "${linkage}")
  endif()
endfunction()

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "${ARGN}")
  endif()
endfunction()

function(vcpkg_cmake_configure)
  cmake_parse_arguments(port "" "SOURCE_PATH" "OPTIONS" ${ARGN})
  run(${CMAKE_COMMAND} -S ${port_SOURCE_PATH} -B ${PREFIX}.build ${port_OPTIONS}
      -DCMAKE_INSTALL_PREFIX=${PREFIX} -DCMAKE_INSTALL_LIBDIR=lib)
endfunction()

function(vcpkg_cmake_install)
  run(${CMAKE_COMMAND} --build ${PREFIX}.build --target install)
endfunction()

# It would move the package's files to where vcpkg looks for them, and write their
# paths anew.
function(vcpkg_cmake_config_fixup)
  cmake_parse_arguments(port "" "CONFIG_PATH" "" ${ARGN})
  if(NOT EXISTS ${PREFIX}/${port_CONFIG_PATH}/fixpidConfig.cmake)
    message(FATAL_ERROR "no ${port_CONFIG_PATH}")
  endif()
endfunction()

function(vcpkg_fixup_pkgconfig)
  if(NOT EXISTS ${PREFIX}/lib/pkgconfig/fixpid.pc)
    message(FATAL_ERROR "no fixpid.pc")
  endif()
endfunction()

function(vcpkg_install_copyright)
  cmake_parse_arguments(port "" "" "FILE_LIST" ${ARGN})
  file(COPY ${port_FILE_LIST} DESTINATION ${PREFIX}/share/fixpid)
endfunction()

include(${PORT}/portfile.cmake)
