# SPDX-License-Identifier: GPL-3.0-or-later
# Has the built program describe itself: cmake -D ARGIL=... -D GZIP=... -D FOLDER=... -P describe.cmake
# leaves FOLDER/man1/*.1.gz, FOLDER/bash/argil and FOLDER/zsh/_argil.
file(REMOVE_RECURSE ${FOLDER}/man1)
file(MAKE_DIRECTORY ${FOLDER}/man1 ${FOLDER}/bash ${FOLDER}/zsh)
execute_process(COMMAND ${ARGIL} man -o ${FOLDER}/man1 --quiet COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${ARGIL} completion bash OUTPUT_FILE ${FOLDER}/bash/argil
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${ARGIL} completion zsh OUTPUT_FILE ${FOLDER}/zsh/_argil
  COMMAND_ERROR_IS_FATAL ANY)
file(GLOB pages ${FOLDER}/man1/*.1)
execute_process(COMMAND ${GZIP} -9n ${pages} COMMAND_ERROR_IS_FATAL ANY)
