#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Plants one fault in a copy of the repository and tells whether the guard meant for it trips with
# the right message: CMake, the compiler or structure.py. Usage: planted_fault.sh FAULT REPOSITORY SCRATCH_FOLDER
set -euo pipefail
fault=$1 repository=$2 scratch=$3
copy=$scratch/copy build=$scratch/build log=$scratch/log

fail() {
  echo "FAILED $fault: $1"
  tail -n 40 "$log"
  exit 1
}

rm -rf "$scratch"
mkdir -p "$copy"
for part in CMakeLists.txt LICENSE README.md CHANGELOG.md docs cmake engine mesh haptics io viewer cli evaluation python; do
  cp -r "$repository/$part" "$copy/"
done
mkdir -p "$copy/tests" # the copy needs a tests folder to have its headers checked, but no test
cp "$repository/tests/structure.py" "$copy/tests/"
echo > "$copy/tests/CMakeLists.txt"

options=(-DARGIL_CORE_ONLY=ON)
configure() {
  "${CMAKE:-cmake}" -G Ninja -S "$copy" -B "$build" -DCMAKE_BUILD_TYPE=Debug -DARGIL_BUILD_TESTS=ON \
    -DARGIL_PCH=OFF -DARGIL_UNITY=OFF "${options[@]}" >"$log" 2>&1
}
build_target() { "${CMAKE:-cmake}" --build "$build" --target "$1" -j 2 >"$log" 2>&1; }

# CMake folds its messages at 77 columns, so they are compared with white space squeezed.
log_says() { tr -s '[:space:]' ' ' <"$log" | grep -qF -- "$1"; }

configuration_stops() { # LINE_TO_APPEND FILE MESSAGE
  echo "$1" >>"$copy/$2"
  ! configure || fail "the configuration went through"
  log_says "$3" || fail "the message does not say: $3"
}
structure_fails() { # MESSAGE
  ! python3 "$copy/tests/structure.py" "$copy" >"$log" 2>&1 || fail "structure.py found nothing"
  log_says "$1" || fail "structure.py does not say: $1"
}
# What CMake and structure.py both refuse, each in words of its own.
both_stop() { # LINE_TO_APPEND FILE MESSAGE MESSAGE_OF_STRUCTURE
  configuration_stops "$1" "$2" "$3"
  structure_fails "$4"
}
compilation_fails() { # LINE_TO_APPEND FILE TARGET MESSAGE
  echo "$1" >>"$copy/$2"
  configure || fail "the configuration stopped, but the fault is for the compiler"
  ! build_target "$3" || fail "$3 was built"
  log_says "$4" || fail "the message does not say: $4"
}

homeless=haptics/include/argil/haptics/homeless # a public header without folder and source
haptics_header=haptics/include/argil/haptics/force/tool_force.h
header_objects=haptics/CMakeFiles/headers_haptics.dir/__/headers/argil/haptics/force
case $fault in
  NoFaultPasses)
    # What the faults below break; all headers are the target that run.sh builds anyway.
    configure || fail "the configuration stopped"
    build_target haptics/CMakeFiles/argil_haptics.dir/src/force/tool_force.cpp.o ||
      fail "a source does not compile"
    target=$header_objects/tool_force.h.cpp.o
    [ -z "${ARGIL_THOROUGH:-}" ] || target=headers
    build_target "$target" || fail "a header does not compile alone"
    ;;
  CoreLinksHapticsStops)
    configuration_stops 'target_link_libraries(argil_core PRIVATE argil::haptics)' \
      haptics/CMakeLists.txt 'Forbidden link edge: argil_core -> argil_haptics'
    ;;
  HapticsPublicThirdPartyStops)
    configuration_stops 'target_link_libraries(argil_haptics PUBLIC Threads::Threads)' \
      haptics/CMakeLists.txt 'Forbidden link edge: argil_haptics -> Threads::Threads is PUBLIC'
    ;;
  HapticsLinksEngineStops)
    options=()
    configuration_stops 'target_link_libraries(argil_haptics PRIVATE argil::engine)' \
      haptics/CMakeLists.txt 'Forbidden link edge: argil_haptics -> argil_engine'
    ;;
  HapticsLinksEngineThroughHelperStops)
    options=()
    configuration_stops 'add_library(helper INTERFACE)
      target_link_libraries(helper INTERFACE $<$<BOOL:ON>:argil::engine>)
      target_link_libraries(argil_haptics PRIVATE helper)' \
      haptics/CMakeLists.txt 'Forbidden link edge: argil_haptics -> helper -> argil_engine'
    ;;
  EngineLinksHapticsStops)
    options=()
    configuration_stops 'target_link_libraries(argil_engine PRIVATE argil::haptics)' \
      engine/CMakeLists.txt 'Forbidden link edge: argil_engine -> argil_haptics'
    ;;
  EngineLinksIoStops)
    options=()
    configuration_stops 'target_link_libraries(argil_engine PRIVATE argil::io)' \
      engine/CMakeLists.txt 'Forbidden link edge: argil_engine -> argil_io'
    ;;
  IoLinksHapticsStops)
    options=()
    configuration_stops 'target_link_libraries(argil_io PRIVATE argil_haptics)' \
      io/CMakeLists.txt 'Forbidden link edge: argil_io -> argil_haptics'
    ;;
  HapticsIncludesEngineRootStops)
    options=()
    configuration_stops \
      'target_include_directories(argil_haptics PRIVATE ${PROJECT_SOURCE_DIR}/engine/src)' \
      haptics/CMakeLists.txt 'Forbidden include root: argil_haptics sees engine/src'
    ;;
  CoreIncludesHapticsRootStops)
    configuration_stops \
      'target_include_directories(argil_core PRIVATE ${PROJECT_SOURCE_DIR}/haptics/include)' \
      engine/core/CMakeLists.txt 'Forbidden include root: argil_core sees haptics/include'
    ;;
  FolderIncludesOneAboveStops)
    both_stop '#include "scene/contact.h"' haptics/src/force/law_table.h \
      'Forbidden include: haptics/src/force/law_table.h includes scene/contact.h, but force stands below scene' \
      'FAULT haptics: force -> scene: law_table.h includes contact.h'
    ;;
  FolderIncludesHeaderAboveStops)
    both_stop '#include <argil/haptics/servo/servo.h>' $haptics_header \
      "Forbidden include: $haptics_header includes argil/haptics/servo/servo.h, but force stands below servo" \
      'FAULT haptics: force -> servo: tool_force.h includes servo.h'
    ;;
  FolderIncludesOneAboveThroughHomelessHeaderStops)
    echo '#include "argil/haptics/servo/servo.h"' >"$copy/$homeless.h"
    both_stop '#include "argil/haptics/homeless.h"' haptics/src/force/law_table.h \
      'law_table.h includes argil/haptics/homeless.h, but force stands below servo' \
      'FAULT haptics: force -> servo: law_table.h includes homeless.h'
    ;;
  FolderIncludesOneAboveThroughTwoHomelessHeadersStops)
    echo '#include "argil/haptics/homeless_too.h"' >"$copy/$homeless.h"
    echo '#include "argil/haptics/servo/servo.h"' >"$copy/${homeless}_too.h"
    both_stop '#include "argil/haptics/homeless.h"' haptics/src/force/law_table.h \
      'law_table.h includes argil/haptics/homeless.h, but force stands below servo' \
      'FAULT haptics: force -> servo: law_table.h includes homeless.h'
    ;;
  FolderIncludesTheTopStops)
    both_stop '#include "commands.h"' cli/common/options.h \
      'cli/common/options.h includes commands.h, but common stands below the top of cli' \
      'FAULT cli: common -> top: options.h includes commands.h'
    ;;
  FolderOutsideTheOrderStops)
    mkdir "$copy/haptics/src/attic"
    both_stop '' haptics/src/attic/old.h 'Unknown folder: haptics/src/attic' \
      'FAULT haptics: the folder attic is in no list of cmake/ArgilLayers.cmake'
    ;;
  PublicFolderOutsideTheOrderStops)
    mkdir "$copy/haptics/include/argil/haptics/attic"
    both_stop '' haptics/include/argil/haptics/attic/old.h 'Unknown folder: haptics/include/argil/haptics/attic' \
      'FAULT haptics: the folder attic is in no list of cmake/ArgilLayers.cmake'
    ;;
  IncludeByDotsStops)
    both_stop '#include "../force/law_table.h"' haptics/src/scene/contact.h \
      'Forbidden include: haptics/src/scene/contact.h includes ../force/law_table.h' \
      'FAULT haptics/src/scene/contact.h includes ../force/law_table.h'
    ;;
  IncludeByDotsWithinStops)
    both_stop '# include "argil/core/../core/vec3.h"' engine/core/src/hash.cpp \
      'Forbidden include: engine/core/src/hash.cpp includes argil/core/../core/vec3.h' \
      'FAULT engine/core/src/hash.cpp includes argil/core/../core/vec3.h'
    ;;
  IncludeByADotStops)
    both_stop '#include "./scene/contact.h"' haptics/src/force/law_table.h \
      'Forbidden include: haptics/src/force/law_table.h includes ./scene/contact.h' \
      'FAULT haptics/src/force/law_table.h includes ./scene/contact.h'
    ;;
  EvaluationIncludesFolderOfCliStops)
    both_stop '#include "shell/completion.h"' evaluation/stability/grid.h \
      'Forbidden include: evaluation/stability/grid.h includes shell/completion.h of cli' \
      'FAULT evaluation/stability/grid.h includes shell/completion.h of cli'
    ;;
  EvaluationIncludesTopOfCliStops)
    both_stop '#include "commands.h"' evaluation/chart/sheet.h \
      'Forbidden include: evaluation/chart/sheet.h includes commands.h of cli' \
      'FAULT evaluation/chart/sheet.h includes commands.h of cli'
    ;;
  PythonIncludesTopOfCliStops)
    both_stop '#include "commands.h"' python/src/convert.h \
      'Forbidden include: python/src/convert.h includes commands.h of cli' \
      'FAULT python/src/convert.h includes commands.h of cli'
    ;;
  EvaluationLinksCliStops)
    options=()
    configuration_stops 'target_link_libraries(argil_evaluation PRIVATE argil_cli)' \
      evaluation/CMakeLists.txt 'Forbidden link edge: argil_evaluation -> argil_cli'
    ;;
  IoLinksCliStops)
    options=()
    configuration_stops 'target_link_libraries(argil_io PRIVATE argil_cli)' \
      io/CMakeLists.txt 'Forbidden link edge: argil_io -> argil_cli'
    ;;
  UnlicensedLibraryFails)
    echo '#include <stb_image.h>' >>"$copy/io/src/format/png.cpp"
    structure_fails 'includes stb_image.h, whose licence is not in cmake/package/copyright'
    echo '#include <thrust/sort.h>' >>"$copy/mesh/src/check/check.cpp"
    structure_fails 'includes thrust, whose licence is not in cmake/package/copyright'
    ;;
  FewAssertsFail)
    # What the compiler checks does not count.
    find "$copy/mesh" -name '*.[ch]*' -exec sed -i -E 's/\bassert\s*\(/static_assert(/' {} +
    structure_fails 'FAULT mesh: 0.0 asserts per 1000 lines; at least 8'
    ;;
  HapticsIncludesEngineHeaderFails)
    compilation_fails '#include "argil/engine/tool.h"' haptics/src/force/tool_force.cpp \
      haptics/CMakeFiles/argil_haptics.dir/src/force/tool_force.cpp.o \
      'argil/engine/tool.h: No such file'
    ;;
  HeaderIncludesThirdPartyFails)
    compilation_fails '#include <openvdb/version.h>' $haptics_header "$header_objects/tool_force.h.cpp.o" \
      'openvdb/version.h: No such file'
    ;;
  HeaderIncludesForbiddenLayerFails)
    compilation_fails '#include "argil/engine/tool.h"' $haptics_header "$header_objects/tool_force.h.cpp.o" \
      'argil/engine/tool.h: No such file'
    ;;
  HeaderNotSelfContainedFails)
    compilation_fails 'inline std::deque<int> undeclared;' $haptics_header "$header_objects/tool_force.h.cpp.o" \
      'does not name a template type'
    ;;
  HeaderWithoutGuardFails)
    echo 'inline int defined_twice() { return 1; }' >"$copy/haptics/include/argil/haptics/force/loose.h"
    compilation_fails '' $haptics_header "$header_objects/loose.h.cpp.o" 'defined_twice'
    ;;
  *)
    echo "planted_fault.sh: no fault '$fault'"
    exit 2
    ;;
esac
echo "$fault: as it should be"
