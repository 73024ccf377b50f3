# SPDX-License-Identifier: GPL-3.0-or-later
# cmake --install, in components: `runtime` is the program and all that it comes with, `dev` are the
# libraries, headers, the CMake package Argil and pkg-config files, `python` is the package argil of Python
# (python/CMakeLists.txt). Debian packages carry these three; `elsewhere` is what other systems want besides.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
include(ArgilNeeds)

# Where Debian keeps libraries of one architecture, whatever the prefix: GNUInstallDirs does so only for
# /usr, but packages are made of a build for any.
set(ARGIL_INSTALL_LIBDIR ${CMAKE_INSTALL_LIBDIR})
if(CMAKE_LIBRARY_ARCHITECTURE AND CMAKE_INSTALL_LIBDIR STREQUAL "lib")
  set(ARGIL_INSTALL_LIBDIR lib/${CMAKE_LIBRARY_ARCHITECTURE})
endif()
set(ARGIL_INSTALL_CMAKEDIR ${ARGIL_INSTALL_LIBDIR}/cmake/Argil)
set(ARGIL_INSTALL_PCDIR ${ARGIL_INSTALL_LIBDIR}/pkgconfig)
set(ARGIL_INSTALL_DOCDIR ${CMAKE_INSTALL_DATAROOTDIR}/doc/argil)
set(CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE
  GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)  # whatever the umask

# argil-LAYER.pc. The libraries are static, so what they need is always linked as well.
function(argil_install_pkg_config layer)
  list(TRANSFORM ARGIL_REACH_${layer} PREPEND argil- OUTPUT_VARIABLE lower)
  list(JOIN lower ", " ARGIL_PC_REQUIRES)
  argil_link_flags(ARGIL_PC_FLAGS ${layer})
  # From the file's own folder, so that the installed tree can be moved.
  set(ARGIL_PC_PREFIX /prefix)
  cmake_path(RELATIVE_PATH ARGIL_PC_PREFIX BASE_DIRECTORY /prefix/${ARGIL_INSTALL_PCDIR})
  configure_file(${PROJECT_SOURCE_DIR}/cmake/package/argil.pc.in
    ${PROJECT_BINARY_DIR}/package/argil-${layer}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/package/argil-${layer}.pc
    DESTINATION ${ARGIL_INSTALL_PCDIR} COMPONENT dev)
endfunction()

# One export file per layer, so that a program that only wants haptics needs no OpenVDB. The window is
# part of the program.
set(ARGIL_INSTALLED_LAYERS "")
foreach(layer IN ITEMS core engine haptics mesh io)
  if(TARGET argil_${layer})
    list(APPEND ARGIL_INSTALLED_LAYERS ${layer})
    install(TARGETS argil_${layer} EXPORT Argil_${layer}
      ARCHIVE DESTINATION ${ARGIL_INSTALL_LIBDIR} COMPONENT dev)
    install(EXPORT Argil_${layer} FILE Argil_${layer}.cmake NAMESPACE argil::
      DESTINATION ${ARGIL_INSTALL_CMAKEDIR} COMPONENT dev)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${ARGIL_ROOT_${layer}}/include/
      DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT dev FILES_MATCHING PATTERN "*.h")
    argil_install_pkg_config(${layer})
  endif()
endforeach()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/ArgilConfig.cmake.in
  ${PROJECT_BINARY_DIR}/ArgilConfig.cmake INSTALL_DESTINATION ${ARGIL_INSTALL_CMAKEDIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/ArgilConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/ArgilConfig.cmake
  ${PROJECT_BINARY_DIR}/ArgilConfigVersion.cmake ${PROJECT_SOURCE_DIR}/cmake/ArgilFind.cmake
  DESTINATION ${ARGIL_INSTALL_CMAKEDIR} COMPONENT dev)

# So that who sits at the machine may open the device; where udev looks, whatever the library folder.
install(FILES ${PROJECT_SOURCE_DIR}/haptics/70-argil-falcon.rules DESTINATION lib/udev/rules.d
  COMPONENT runtime)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/haptics/calibration/
  DESTINATION ${CMAKE_INSTALL_DATADIR}/argil/falcon COMPONENT runtime)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/printers DESTINATION ${CMAKE_INSTALL_DATADIR}/argil
  COMPONENT runtime)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples/alphas DESTINATION ${CMAKE_INSTALL_DATADIR}/argil
  COMPONENT runtime FILES_MATCHING PATTERN "*.png")

# Documents without the data that their charts are drawn from, and the examples that need no source tree.
install(FILES ${PROJECT_SOURCE_DIR}/README.md DESTINATION ${ARGIL_INSTALL_DOCDIR} COMPONENT runtime)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs DESTINATION ${ARGIL_INSTALL_DOCDIR} COMPONENT runtime
  PATTERN "*.csv" EXCLUDE PATTERN "*.gp" EXCLUDE)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/examples DESTINATION ${ARGIL_INSTALL_DOCDIR}
  COMPONENT runtime FILES_MATCHING PATTERN "*.jsonl" PATTERN "*.ply" PATTERN "*.py"
  PATTERN "__pycache__" EXCLUDE)
# Packages have them under Debian's names (ArgilPackage.cmake).
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/CHANGELOG.md
  DESTINATION ${ARGIL_INSTALL_DOCDIR} COMPONENT elsewhere)

# What only the program needs: a desktop, manual pages, shells, Blender.
function(argil_install_program)
  install(TARGETS argil RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT runtime)
  set(package ${PROJECT_SOURCE_DIR}/cmake/package)
  install(FILES ${package}/argil.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications
    COMPONENT runtime)
  install(FILES ${package}/argil.svg
    DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps COMPONENT runtime)
  install(FILES ${package}/argil.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages
    COMPONENT runtime)

  find_program(ARGIL_GZIP gzip REQUIRED)
  set(described ${PROJECT_BINARY_DIR}/package/described)
  add_custom_command(OUTPUT ${described}/zsh/_argil
    COMMAND ${CMAKE_COMMAND} -D ARGIL=$<TARGET_FILE:argil> -D GZIP=${ARGIL_GZIP}
      -D FOLDER=${described} -P ${package}/describe.cmake
    DEPENDS argil ${package}/describe.cmake VERBATIM
    COMMENT "Manual pages and completions, from argil's own command line")
  add_custom_target(argil_described ALL DEPENDS ${described}/zsh/_argil)
  install(DIRECTORY ${described}/man1/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT runtime)
  install(FILES ${described}/bash/argil
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT runtime)
  install(FILES ${described}/zsh/_argil
    DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT runtime)
  install(FILES ${described}/zsh/_argil
    DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions COMPONENT elsewhere)

  # As a package of Python, so that Blender lists one add-on and not each of its files; where Blender
  # looks before 4.2, and from then on.
  set(blender ${PROJECT_SOURCE_DIR}/examples/blender)
  file(GLOB modules CONFIGURE_DEPENDS ${blender}/argil_*.py)
  list(REMOVE_ITEM modules ${blender}/argil_addon.py ${blender}/argil_session.py)
  configure_file(${package}/blender_manifest.toml.in
    ${PROJECT_BINARY_DIR}/package/blender_manifest.toml @ONLY)
  # Before 4.2 an add-on is a module of its folder's name: `argil` is the package of Python.
  foreach(place IN ITEMS scripts/addons/argil_blender extensions/system/argil)
    set(addon ${CMAKE_INSTALL_DATADIR}/blender/${place})
    install(FILES ${modules} DESTINATION ${addon} COMPONENT runtime)
    install(FILES ${blender}/argil_addon.py DESTINATION ${addon} RENAME __init__.py
      COMPONENT runtime)
  endforeach()
  install(FILES ${PROJECT_BINARY_DIR}/package/blender_manifest.toml
    DESTINATION ${CMAKE_INSTALL_DATADIR}/blender/extensions/system/argil COMPONENT runtime)
endfunction()
if(TARGET argil)
  argil_install_program()
endif()
