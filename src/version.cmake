# SPDX-License-Identifier: GPL-3.0-or-later
# Writes OUTPUT with the version and the commit of the sources, only when they changed: run at every
# build, so that a log never names a commit the program was not built from.
find_package(Git QUIET)
set(commit "")
if(GIT_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${SOURCE} describe --always --dirty --abbrev=12 --exclude=*
                  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
endif()
if(commit)
  set(commit ", commit ${commit}")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define SPAM_VERSION \"${VERSION}${commit}\"\n")
