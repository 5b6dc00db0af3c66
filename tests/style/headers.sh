#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every header below <folder>/spam compiles by itself, whatever was included before it or not.
#   headers.sh <folder> <a folder to work in> <compiler and its flags...>
# Eigen is read once: to precompile <Eigen/Core> changes nothing for headers that include it, directly
# or through others of ours. All others are compiled without. What another header of the same kind includes
# before all else is compiled by itself there.
set -euo pipefail
folder=$1 work=$2
shift 2
compile=("$@" -I "$folder")

mkdir -p "$work"
echo '#include <Eigen/Core>' >"$work/eigen.hpp"
"${compile[@]}" -x c++-header "$work/eigen.hpp" -o "$work/eigen.hpp.gch"

# Lines "<eigen or plain> <header>".
kinds() {
    (cd "$folder" && find spam -name '*.hpp' -exec awk '
        { name = FILENAME; all[name] }
        /^ *# *include/ && !(name in begins) {
            split($0, part, /[<">]/); begins[name] = part[2]
        }
        /^ *# *include *<Eigen\// { eigen[name] }
        /^ *# *include *[<"]spam\// { split($0, part, /[<">]/); edge[name, part[2]] }
        END {
            do {
                changed = 0
                for (e in edge) {
                    split(e, end, SUBSEP)
                    if (end[2] in eigen && !(end[1] in eigen)) { eigen[end[1]]; changed = 1 }
                }
            } while (changed)
            for (name in all)
                if ((name in eigen) == (begins[name] in eigen)) alone_there[begins[name]]
            for (name in all)
                if (!(name in alone_there)) print (name in eigen ? "eigen" : "plain"), name
        }' {} +)
}

alone() { # kind, header, compiler...
    local kind=$1 header=$2 first=()
    shift 2
    if [[ $kind == eigen ]]; then first=(-include "$work/eigen.hpp"); fi
    "$@" "${first[@]}" -x c++ -fsyntax-only - <<<"#include <$header>" || {
        echo "$header does not compile by itself" >&2
        return 1
    }
}
export -f alone
export work

kinds >"$work/headers"
echo "$(wc -l <"$work/headers") headers"
# shellcheck disable=SC2016  # for the shell below
xargs -P 2 -L 1 bash -c 'alone "${@: -2}" "${@:1:$#-2}"' alone "${compile[@]}" <"$work/headers"
