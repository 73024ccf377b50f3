# SPDX-License-Identifier: GPL-3.0-or-later
# cpack: argil_*.deb, libargil-dev_*.deb and python3-argil_*.deb of the components `runtime`, `dev` and `python`
# (docs/installing.md).
if(NOT PROJECT_IS_TOP_LEVEL OR NOT TARGET argil)
  return()
endif()

set(ARGIL_PACKAGE_MAINTAINER "" CACHE STRING "Who makes the packages, as NAME <MAIL>")
if(NOT ARGIL_PACKAGE_MAINTAINER)
  # What Debian's own tools read.
  if(NOT "$ENV{DEBFULLNAME}" STREQUAL "" AND NOT "$ENV{DEBEMAIL}" STREQUAL "")
    set(ARGIL_PACKAGE_MAINTAINER "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
  else()
    set(ARGIL_PACKAGE_MAINTAINER "The Argil authors <argil@packages.invalid>")
  endif()
endif()

# Packages of two releases are of one source but of different libraries: 0.1.0-1~deb12, 0.1.0-1~deb13.
# The tilde sorts them before a 0.1.0-1 of the distribution itself.
cmake_host_system_information(RESULT ARGIL_OS QUERY DISTRIB_INFO)
set(ARGIL_OS_NAME ${ARGIL_OS_ID})
if(ARGIL_OS_ID STREQUAL "debian")
  set(ARGIL_OS_NAME deb)
endif()
set(ARGIL_DEB_RELEASE 1~${ARGIL_OS_NAME}${ARGIL_OS_VERSION_ID})
set(ARGIL_DEB_VERSION ${PROJECT_VERSION}-${ARGIL_DEB_RELEASE})
set(ARGIL_DEB_SUITE unstable)
if(ARGIL_OS_VERSION_CODENAME)
  set(ARGIL_DEB_SUITE ${ARGIL_OS_VERSION_CODENAME})
endif()

set(ARGIL_DEB_PACKAGES argil:runtime libargil-dev:dev)
if(TARGET argil_python)
  list(APPEND ARGIL_DEB_PACKAGES python3-argil:python)
endif()

# All packages have the copyright and the two changelogs in a folder of their own name.
string(TIMESTAMP ARGIL_DEB_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)  # or SOURCE_DATE_EPOCH
configure_file(cmake/package/changelog.in ${PROJECT_BINARY_DIR}/package/changelog.Debian @ONLY)
configure_file(CHANGELOG.md ${PROJECT_BINARY_DIR}/package/changelog COPYONLY)
execute_process(COMMAND ${ARGIL_GZIP} -9nfk changelog.Debian changelog
  WORKING_DIRECTORY ${PROJECT_BINARY_DIR}/package COMMAND_ERROR_IS_FATAL ANY)
foreach(package IN LISTS ARGIL_DEB_PACKAGES)
  string(REPLACE ":" ";" package ${package})
  list(POP_FRONT package name)
  install(FILES ${PROJECT_BINARY_DIR}/package/changelog.Debian.gz
    ${PROJECT_BINARY_DIR}/package/changelog.gz cmake/package/copyright
    DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${name} COMPONENT ${package})
endforeach()

set(CPACK_GENERATOR DEB)
set(CPACK_SOURCE_GENERATOR "")
set(CPACK_COMPONENTS_ALL runtime dev)
if(TARGET argil_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS ${CMAKE_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS})
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_CONTACT "${ARGIL_PACKAGE_MAINTAINER}")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${ARGIL_DEB_RELEASE})
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # the first line of each package's own description

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME argil)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SECTION graphics)
# What the program starts or opens by name, which dpkg-shlibdeps does not see: the letters of the
# window, the OpenGL that epoxy loads, what draws charts.
set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "fonts-dejavu-core, libgl1, gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "blender, prusa-slicer")
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION "sculpts digital clay that can be felt and printed
Argil turns a scan or a ball of clay into a stack of sparse level sets, fine
only where there is detail. Tools add, carve, smooth and move it, from a script
or in a window; what leaves is one closed mesh that a 3D printer takes.

A hand that holds a Novint Falcon, or a simulated one, feels the clay, and also
the scenes of Blender through the add-on that comes with it.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libargil-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS argil)
set(CPACK_COMPONENT_DEV_DESCRIPTION "sculpts digital clay that can be felt (libraries)
Argil turns a scan or a ball of clay into a stack of sparse level sets, fine
only where there is detail, sculpts it, tells what a hand that holds the tool
feels, and writes closed meshes for 3D printers.

These are the static libraries core, haptics, engine, mesh and io with their
headers, for CMake's find_package(Argil) and for pkg-config.")

# The extension is of one version of Python alone; what it links, dpkg-shlibdeps sees.
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-argil)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
math(EXPR ARGIL_PYTHON_NEXT "${Python_VERSION_MINOR} + 1")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.${Python_VERSION_MINOR}~), python3 (<< 3.${ARGIL_PYTHON_NEXT}), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-distributed, python3-matplotlib")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/cmake/package/python/postinst
  ${PROJECT_SOURCE_DIR}/cmake/package/python/prerm)
set(CPACK_COMPONENT_PYTHON_DESCRIPTION "sculpts digital clay that can be felt (Python 3)
Argil turns a scan or a ball of clay into a stack of sparse level sets, fine
only where there is detail, sculpts it, tells what a hand that holds the tool
feels, and writes closed meshes for 3D printers.

This is its package for Python: arrays of NumPy in and out.")
argil_needed_files(CPACK_ARGIL_NEEDED_FILES ${ARGIL_INSTALLED_LAYERS})
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/cmake/package/dependencies.cmake)
include(CPack)
