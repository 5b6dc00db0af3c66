# SPDX-License-Identifier: GPL-3.0-or-later
# Writes OUTPUT with the version and the commit of the sources, only when they changed: run at every
# build, so that a log never names a commit the program was not built from.
find_package(Git QUIET)
# Written by `git archive`: in what it leaves there is no history to ask.
set(commit "$Format:%H$")
string(SUBSTRING "${commit}" 0 12 commit)
if(commit MATCHES "Format")
  set(commit "")
endif()
# Sources unpacked somewhere in another project's tree must not name a commit of that project.
set(folder "?")
if(GIT_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${SOURCE} rev-parse --show-prefix
                  OUTPUT_VARIABLE folder OUTPUT_STRIP_TRAILING_WHITESPACE
                  RESULT_VARIABLE failed ERROR_QUIET)
endif()
if(GIT_FOUND AND failed EQUAL 0 AND folder STREQUAL "")
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
                  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(commit)
  set(commit ", commit ${commit}")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define SPAM_VERSION \"${VERSION}${commit}\"\n")
