# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash disable=SC2034,SC2154,SC2164  # read by ./spam, under set -e
#|  ./spam python <script> [arguments]
#|                                    build the module spam_mechanics and run a script of Python with it

# The distribution's Python: another one on PATH (pyenv, conda) has neither its numpy nor its headers.
readonly python_packages=(pybind11-dev python3-dev python3-numpy python3-matplotlib)

verb_python() { # <script> [its arguments...]
    local python=/usr/bin/python3 folder=$root/build/$preset/python parts=(include src) module
    (($#)) || refuse "python: which script? one of Python that says 'import spam_mechanics as spam'"
    [[ $1 == -* || -f $1 ]] || refuse "python: there is no script '$1'"
    module=$(compgen -G "$folder/spam_mechanics/_core*.so" || true)
    if ! is_up_to_date "$module" "${parts[@]}"; then
        set_up "${python_packages[@]}" -- SPAM_BUILD_PYTHON=ON -- spam_python
    fi
    [[ -x $python ]] || stop python "there is no $python" "install python3 and python3-numpy"
    export PYTHONPATH=$folder${PYTHONPATH:+:$PYTHONPATH}
    exec "$python" "$@"
}
