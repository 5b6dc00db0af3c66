# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash disable=SC2034,SC2154,SC2164  # read by ./spam, under set -e
#|  ./spam docs [options]             build the pages of documentation in build/docs; --help lists the options

# Of the distribution's own python3, whatever lies before it in PATH.
readonly docs_packages=(doxygen python3-sphinx python3-breathe python3-myst-parser furo libjs-mathjax)

verb_docs() { # [options of src/docs/build.py...]
    install_packages "${docs_packages[@]}"
    [[ -x /usr/bin/python3 ]] || { say "docs: there is no /usr/bin/python3; install python3" && exit "$set_up_failed"; }
    exec /usr/bin/python3 -B "$root/src/docs/build.py" "$@"
}
