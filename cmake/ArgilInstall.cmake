# SPDX-License-Identifier: GPL-3.0-or-later
# cmake --install: program, libraries, headers, the CMake package Argil, documents and licence.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(ARGIL_INSTALL_CMAKEDIR ${CMAKE_INSTALL_LIBDIR}/cmake/Argil)

# One export file per layer, so that a program that only wants haptics needs no OpenVDB. The window is
# part of the program.
set(ARGIL_INSTALLED_LAYERS "")
foreach(layer IN ITEMS core engine haptics io)
  if(TARGET argil_${layer})
    list(APPEND ARGIL_INSTALLED_LAYERS ${layer})
    install(TARGETS argil_${layer} EXPORT Argil_${layer}
      ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(EXPORT Argil_${layer} FILE Argil_${layer}.cmake NAMESPACE argil::
      DESTINATION ${ARGIL_INSTALL_CMAKEDIR})
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${ARGIL_ROOT_${layer}}/include/
      DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
  endif()
endforeach()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/ArgilConfig.cmake.in
  ${PROJECT_BINARY_DIR}/ArgilConfig.cmake INSTALL_DESTINATION ${ARGIL_INSTALL_CMAKEDIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ArgilConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ArgilConfig.cmake
  ${PROJECT_BINARY_DIR}/ArgilConfigVersion.cmake ${PROJECT_SOURCE_DIR}/cmake/ArgilFind.cmake
  DESTINATION ${ARGIL_INSTALL_CMAKEDIR})

# So that who sits at the machine may open the device; where udev looks, whatever the library folder.
install(FILES ${PROJECT_SOURCE_DIR}/haptics/70-argil-falcon.rules DESTINATION lib/udev/rules.d)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/haptics/calibration/
  DESTINATION ${CMAKE_INSTALL_DATADIR}/argil/falcon)

if(TARGET argil)
  install(TARGETS argil RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/LICENSE
  ${PROJECT_SOURCE_DIR}/CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/printers DESTINATION ${CMAKE_INSTALL_DATADIR}/argil)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}
  FILES_MATCHING PATTERN "*.jsonl")
