# SPDX-License-Identifier: GPL-3.0-or-later
# Read by ctest after it discovered the tests of tests/FOLDER, listed in argil_tests. The end of a
# suite's name says its label: TEST(RedistanceGolden, ...) is `golden`; without one it is `unit`. The
# folder is a label as well, and what runs threads of core and haptics has the label `threads`.
#
# Tests that follow a clock have the label `clock` and run one at a time; tests/run.sh runs the others
# beside them. What takes longest begins first, so that nothing is left to run alone at the end.
foreach(test IN LISTS argil_tests)
  string(REGEX REPLACE "^([A-Za-z0-9_]+/)?([A-Za-z0-9_]+)(/[0-9]+)?\\..*$" "\\2" suite "${test}")
  set(label unit)
  if(suite MATCHES "(Property|Golden|Realtime|Slow|Gl|Client|Device)$")
    string(TOLOWER "${CMAKE_MATCH_1}" label)
  endif()
  set(labels ${label} ${argil_folder})
  if(suite MATCHES "^(Falcon|Servo|HapticRig|Bridge|Recording|SpscRing|TripleBuffer)|Stress$")
    list(APPEND labels threads)
  endif()
  set(properties "")
  if(label MATCHES "^(realtime|device)$" OR suite MATCHES "^(Falcon|Bridge.*(Client|Ends)|HapticRig)" OR
     test MATCHES "^ViewWindowGl.*(Force|SimulatedFalcon)|InRealTime$")
    list(APPEND labels clock)
    list(APPEND properties RESOURCE_LOCK clock PROCESSORS 2)
  endif()
  if(label STREQUAL "slow")
    list(APPEND properties TIMEOUT 1800)
  endif()
  if(label MATCHES "^(slow|client|property)$" OR suite MATCHES "^(Chart|LabDefaults|FirstSculpture)")
    list(APPEND properties COST 100)
  endif()
  set_tests_properties("${test}" PROPERTIES LABELS "${labels}" ${properties})
endforeach()
