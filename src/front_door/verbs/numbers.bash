# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash disable=SC2034,SC2154,SC2164  # read by ./spam, under set -e
#|  ./spam numbers [--check|--write] [--quick]
#|                                    compare the numbers of the documents with the runs that they come
#|                                    from, or write them anew; --help lists the options

verb_numbers() { # [options of src/numbers/numbers.py...]
    local python=python3 more=()
    install_packages python3
    if [[ -x /usr/bin/python3 ]]; then python=/usr/bin/python3; fi
    command -v "$python" >/dev/null || { say "numbers: there is no python3; install python3" && exit "$set_up_failed"; }
    if [[ $install == no ]]; then more+=(--no-install); fi
    exec "$python" -B "$root/src/numbers/numbers.py" "${more[@]}" "$@"
}
