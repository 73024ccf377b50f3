# SPDX-License-Identifier: GPL-3.0-or-later
# Read by cpack: libargil-dev depends on the packages that own the files which its libraries were built
# against. dpkg-shlibdeps does the same for the program, but cannot see into static libraries.
set(packages "")
foreach(file IN LISTS CPACK_ARGIL_NEEDED_FILES)
  # dpkg knows a file by the name it was packed with, from before /lib became a link or after.
  string(REGEX REPLACE "^/usr/" "/" unmerged "${file}")
  set(owners "")
  foreach(name IN ITEMS ${file} ${unmerged})
    execute_process(COMMAND dpkg-query --search ${name}
      OUTPUT_VARIABLE found ERROR_QUIET RESULT_VARIABLE status)
    if(status EQUAL 0)
      string(REGEX REPLACE ":[^\n]*" "" owners "${found}")
      string(STRIP "${owners}" owners)
      break()
    endif()
  endforeach()
  if(owners STREQUAL "" OR owners MATCHES "[\n,]")
    message(FATAL_ERROR "${file}, which Argil was built against, belongs to no one Debian package "
      "('${owners}'), so libargil-dev cannot depend on it. Build against Debian's packages "
      "(cmake/setup.sh build), or use cmake --install instead of cpack.")
  endif()
  list(APPEND packages ${owners})
endforeach()
list(REMOVE_DUPLICATES packages)
list(SORT packages)
list(JOIN packages ", " CPACK_DEBIAN_DEV_PACKAGE_DEPENDS)
