# SPDX-License-Identifier: GPL-3.0-or-later
# Packages and recipes say what the project says: its version, its packages, its build type.
#   SOURCE: the project
set(package ${SOURCE}/src/package)
set(wrong "")

# asked(<file> <regular expression> <what for>)
function(asked file pattern words)
  file(READ ${file} text)
  if(NOT text MATCHES "${pattern}")
    set(wrong "${wrong}\n  ${file}: ${words}" PARENT_SCOPE)
  endif()
endfunction()

file(STRINGS ${SOURCE}/CMakeLists.txt project REGEX "^project[(]spam VERSION")
string(REGEX MATCH "([0-9]+[.][0-9]+)[.][0-9]+" version "${project}")
set(minor ${CMAKE_MATCH_1})
string(REPLACE "." "[.]" exactly ${version})
asked(${package}/debian/changelog "^spam [(]${exactly}-" "is not of version ${version}")
asked(${package}/debian/control "\nPackage: libspam${minor}\n" "has no package libspam${minor}")
asked(${package}/spack/package.py "version[(]\"${exactly}\"" "is not of version ${version}")
asked(${package}/conda/meta.yaml "version: ${exactly}\n" "is not of version ${version}")
asked(${SOURCE}/.zenodo.json "\"version\": \"${exactly}\"" "is not of version ${version}")
if(NOT EXISTS ${package}/debian/libspam${minor}.install)
  string(APPEND wrong "\n  there is no list libspam${minor}.install")
endif()

# Debhelper's own build type leaves assertions in.
foreach(option -DCMAKE_BUILD_TYPE=Release -DBUILD_SHARED_LIBS=ON)
  asked(${package}/debian/rules "dh_auto_configure --[^#]* ${option}[ \n]" "does not say ${option}")
endforeach()

# What ./spam installs before it builds, packages ask for as well; a compiler is always there.
file(READ ${SOURCE}/src/front_door/tree.bash tree)
string(REGEX MATCH "build_packages=[(]([^)]*)[)]" found "${tree}")
string(REGEX MATCHALL "[^ \n]+" names "${CMAKE_MATCH_1}")
list(LENGTH names count)
if(count LESS 10)
  string(APPEND wrong "\n  ${count} packages found in src/front_door/tree.bash")
endif()
list(REMOVE_ITEM names g++)
foreach(name IN LISTS names)
  asked(${package}/debian/control "\n ${name}[ ,\n]" "does not ask for ${name}")
endforeach()

# Every test of the installed packages has a file, and every file is a test.
file(STRINGS ${package}/debian/tests/control listed REGEX "^Tests: ")
list(TRANSFORM listed REPLACE "^Tests: " "")
file(GLOB there RELATIVE ${package}/debian/tests ${package}/debian/tests/*)
list(REMOVE_ITEM there control)
list(SORT listed)
list(SORT there)
if(NOT listed STREQUAL there)
  string(APPEND wrong "\n  debian/tests/control lists '${listed}', there are '${there}'")
endif()

if(wrong)
  message(FATAL_ERROR "packages do not agree with the project:${wrong}")
endif()
