# SPDX-License-Identifier: GPL-3.0-or-later
# Tests that run the problem executables as a user would.
find_package(nlohmann_json REQUIRED)
spam_problem_test(problem/bad_input)
spam_problem_test(problem/results nlohmann_json::nlohmann_json)
spam_problem_test(problem/snapshots nlohmann_json::nlohmann_json)
spam_problem_test(problem/folders)
spam_problem_test(problem/stops nlohmann_json::nlohmann_json)
spam_problem_test(problem/terminal)
spam_problem_test(problem/surroundings nlohmann_json::nlohmann_json)
spam_problem_test(problem/every_problem nlohmann_json::nlohmann_json)
spam_problem_test(problem/figures nlohmann_json::nlohmann_json)
spam_problem_test(problem/waves nlohmann_json::nlohmann_json)
spam_problem_test(problem/sweep nlohmann_json::nlohmann_json)
