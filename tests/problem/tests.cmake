# SPDX-License-Identifier: GPL-3.0-or-later
# Tests that run the problem executables as a user would.
spam_problem_test(problem/bad_input)
spam_problem_test(problem/idle_options)
math(EXPR longest "3 * ${timeout}")  # on a busy machine
set_tests_properties(problem.idle_options PROPERTIES ENVIRONMENT SPAM_FIFTH=0 TIMEOUT ${longest})
foreach(fifth 1 2 3 4)
  add_test(NAME problem.idle_options.${fifth} COMMAND test.problem.idle_options)
  set_tests_properties(problem.idle_options.${fifth} PROPERTIES
    LABELS problem TIMEOUT ${longest} ENVIRONMENT SPAM_FIFTH=${fifth})
endforeach()
spam_problem_test(problem/extremes)
spam_hunt(problem/extremes 5)
spam_problem_test(problem/random_sides)
spam_hunt(problem/random_sides 5)
spam_problem_test(problem/guards)
spam_problem_test(problem/results)
spam_problem_test(problem/snapshots)
spam_problem_test(problem/declared_units)
spam_problem_test(problem/folders)
spam_problem_test(problem/hostile_folders)
spam_problem_test(problem/forged_checkpoints)
spam_hunt(problem/forged_checkpoints 20)
if(SPAM_BUILD_VIEW)
  spam_problem_test(problem/damaged_results spam_view)
  target_include_directories(test.problem.damaged_results PRIVATE ${PROJECT_SOURCE_DIR}/src)
  target_compile_definitions(test.problem.damaged_results PRIVATE SPAM_VIEW="$<TARGET_FILE:spam-view>")
  add_dependencies(test.problem.damaged_results spam-view)
  spam_hunt(problem/damaged_results 10)
endif()
spam_problem_test(problem/stops)
spam_problem_test(problem/terminal)
spam_problem_test(problem/surroundings)
spam_problem_test(problem/memory)
spam_problem_test(problem/ranks_bytes)
spam_problem_test(problem/ranks_end)
set_tests_properties(problem.ranks_bytes PROPERTIES ENVIRONMENT SPAM_QUARTER=0 PROCESSORS 2)
set_tests_properties(problem.ranks_end PROPERTIES PROCESSORS 2)
spam_long(problem/ranks_end)
if(SPAM_SANITIZE)  # Open MPI itself leaks 0.1 MB from its start to its end, and this test reads all that is printed
  set_property(TEST problem.ranks_end long.problem.ranks_end APPEND PROPERTY ENVIRONMENT
    ASAN_OPTIONS=detect_leaks=0:detect_stack_use_after_return=1:check_initialization_order=1)
endif()
# A problem that fails between any two exchanges.
add_executable(failing_problem ${PROJECT_SOURCE_DIR}/problems/counter_rotating.cpp
                               ${CMAKE_CURRENT_SOURCE_DIR}/problem/failing_exchange.cpp)
target_link_libraries(failing_problem PRIVATE problem_options spam::spam)
target_link_options(failing_problem PRIVATE LINKER:--wrap=_ZN4spam14join_processesEv)
target_compile_definitions(test.problem.ranks_end PRIVATE
  SPAM_FAILING_PROBLEM="$<TARGET_FILE:failing_problem>")
add_dependencies(test.problem.ranks_end failing_problem)
foreach(quarter 1 2 3)
  add_test(NAME problem.ranks_bytes.${quarter} COMMAND test.problem.ranks_bytes --log_level=message)
  set_tests_properties(problem.ranks_bytes.${quarter} PROPERTIES
    LABELS problem TIMEOUT ${timeout} ENVIRONMENT SPAM_QUARTER=${quarter} PROCESSORS 2)
endforeach()
spam_problem_test(problem/every_problem)
spam_problem_test(readme/documents)
spam_problem_test(problem/figures)
spam_problem_test(problem/waves)
spam_problem_test(problem/short_ranges)
spam_test(problem/lattice_sums property)  # a part of the problem kernels
target_include_directories(test.problem.lattice_sums PRIVATE ${PROJECT_SOURCE_DIR}/problems)
spam_problem_test(problem/density_potentials)
spam_problem_test(problem/separation)
target_sources(test.problem.separation PRIVATE
  ${PROJECT_SOURCE_DIR}/problems/phase_separation/domains.cpp)
target_include_directories(test.problem.separation PRIVATE ${PROJECT_SOURCE_DIR}/problems)
spam_problem_test(problem/flows)
spam_problem_test(problem/wall_flows)
spam_problem_test(problem/plastic)
spam_problem_test(problem/water_column)
spam_problem_test(problem/column_of_elements)
spam_problem_test(problem/tension_test)
spam_problem_test(problem/ball_plate)
spam_problem_test(problem/stirred_flows)
spam_problem_test(problem/units)
spam_problem_test(problem/mesh_modes)
spam_problem_test(problem/md_fields)
spam_problem_test(problem/space)
spam_problem_test(problem/pierced_bar)
spam_problem_test(problem/contacts)
spam_problem_test(problem/cantilever)
target_sources(test.problem.cantilever PRIVATE ${PROJECT_SOURCE_DIR}/problems/cantilever/beam.cpp)
target_include_directories(test.problem.cantilever PRIVATE ${PROJECT_SOURCE_DIR}/problems)
spam_problem_test(problem/material_vectors)
spam_problem_test(problem/expansion)
spam_problem_test(problem/sweep)
spam_problem_test(problem/guarded_runs)
spam_problem_test(problem/restart)
spam_problem_test(problem/two_runs)
spam_problem_test(problem/stopped_runs)
spam_problem_test(problem/restart_table)
spam_problem_test(problem/rezoned_runs)
spam_problem_test(problem/locks)
spam_problem_test(problem/early_signals)
spam_problem_test(problem/restart_key)
spam_problem_test(problem/full_disk)
spam_problem_test(problem/integrators)
spam_test(problem/own_study problem spam_test_files)
spam_test(problem/judged problem spam_test_files)
spam_test(problem/variants problem spam_test_files)
spam_test(problem/taken_folders problem spam_test_files)
spam_test(problem/drift_guard unit)
spam_test(problem/sides unit)
spam_test(problem/walls property)  # parts of the problem relaxation
target_sources(test.problem.walls PRIVATE ${PROJECT_SOURCE_DIR}/problems/relaxation/region.cpp
                                          ${PROJECT_SOURCE_DIR}/problems/relaxation/wall.cpp
                                          ${PROJECT_SOURCE_DIR}/problems/relaxation/quality.cpp)
target_include_directories(test.problem.walls PRIVATE ${PROJECT_SOURCE_DIR}/problems)
spam_test(problem/mirror_twin property)  # parts of the problem free_expansion
target_sources(test.problem.mirror_twin PRIVATE ${PROJECT_SOURCE_DIR}/problems/free_expansion/gas.cpp
                                                ${PROJECT_SOURCE_DIR}/problems/free_expansion/entropy.cpp)
target_include_directories(test.problem.mirror_twin PRIVATE ${PROJECT_SOURCE_DIR}/problems)
spam_test(problem/cavity_reference property)  # a part of the problem cavity
target_sources(test.problem.cavity_reference PRIVATE ${PROJECT_SOURCE_DIR}/problems/cavity/centre_line.cpp)
target_include_directories(test.problem.cavity_reference PRIVATE ${PROJECT_SOURCE_DIR}/problems)
spam_test(problem/element_twins property)  # parts of the problems tension_test and ball_plate
target_sources(test.problem.element_twins PRIVATE
  ${PROJECT_SOURCE_DIR}/problems/tension_test/elements.cpp
  ${PROJECT_SOURCE_DIR}/problems/ball_plate/elements.cpp)
target_include_directories(test.problem.element_twins PRIVATE ${PROJECT_SOURCE_DIR}/problems)

# What ParaView would read, read by VTK itself where it is installed.
find_program(SPAM_PYTHON NAMES python3 HINTS /usr/bin)  # whose packages the system's are
if(SPAM_PYTHON)
  add_test(NAME io.read_by_vtk COMMAND ${SPAM_PYTHON}
    ${CMAKE_CURRENT_SOURCE_DIR}/io/read_by_vtk.py $<TARGET_FILE:free_expansion>
    ${CMAKE_CURRENT_BINARY_DIR}/read_by_vtk)
  set_tests_properties(io.read_by_vtk PROPERTIES LABELS problem TIMEOUT ${timeout}
    SKIP_RETURN_CODE 77)
endif()

# The program of a page on a run whose particles change, where node is installed.
find_program(SPAM_NODE NAMES node nodejs)
if(SPAM_NODE AND SPAM_BUILD_VIEW)
  add_test(NAME view.changing_ids COMMAND ${SPAM_NODE}
    ${CMAKE_CURRENT_SOURCE_DIR}/view/changing_ids.js ${PROJECT_SOURCE_DIR}/src/view/page
    $<TARGET_FILE:spam-view> $<TARGET_FILE:gas_cloud> ${CMAKE_CURRENT_BINARY_DIR}/view_changing_ids)
  set_tests_properties(view.changing_ids PROPERTIES LABELS problem TIMEOUT ${timeout})
endif()

# A page in Chromium (with python3-selenium) and in Firefox, where they are installed.
if(SPAM_PYTHON AND SPAM_BUILD_VIEW)
  add_test(NAME view.browser COMMAND ${SPAM_PYTHON}
    ${CMAKE_CURRENT_SOURCE_DIR}/view/browser.py $<TARGET_FILE:spam-view>
    $<TARGET_FILE:rotating_hexagon> $<TARGET_FILE:free_expansion>
    $<TARGET_FILE:ball_plate> $<TARGET_FILE:taylor_bar> ${CMAKE_CURRENT_BINARY_DIR}/view_browser)
  set_tests_properties(view.browser PROPERTIES LABELS problem TIMEOUT ${timeout}
    SKIP_RETURN_CODE 77)
endif()
spam_long(drift/material_vectors drift/material_vector_bodies drift/material_vector_matter physics/lattice_strength
          rhs/parts rhs/parts_in_space rhs/units rhs/units_in_space)
spam_long(problem/ball_plate problem/cantilever problem/column_of_elements problem/early_signals problem/element_twins
          problem/every_problem problem/expansion problem/flows problem/idle_options problem/ranks_bytes problem/restart
          problem/restart_table problem/short_ranges problem/space problem/stirred_flows problem/tension_test
          problem/wall_flows problem/water_column)
