#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Every header below <folder>/spam compiles by itself, whatever was included before it or not.
#   headers.sh <folder> <a folder to work in> <compiler and its flags...>
# Headers of libraries are read once for many of ours: to precompile a set of them changes nothing for a header
# that includes all of the set itself, directly or through others of ours. It is compiled with the first of the
# sets below for which that is so, or with none. For the same reason a header is compiled after one that it
# includes, in the same run of the compiler: a chain of them is one run.
set -euo pipefail
folder=$1 work=$2
shift 2
compile=("$@" -I "$folder")

# Those that most of ours include, the dearest first.
sets=(
    "Eigen/Core cmath chrono filesystem functional memory span string vector"
    "Eigen/Core cmath algorithm fmt/format.h immintrin.h span string vector"
    "Eigen/Core cmath functional memory span string vector"
    "Eigen/Core cmath span string vector"
    "cmath immintrin.h string vector"
    "cmath immintrin.h"
    "cmath fmt/format.h string"
    "filesystem string"
    "string"
)

mkdir -p "$work"
printf '%s\n' "${sets[@]}" >"$work/sets"

# Lines "<number of the set, 0 for none> <headers, each of which includes the one before it>".
chains() {
    (cd "$folder" && find spam -name '*.hpp' -exec awk '
        # The headers that <name> includes, itself or through others.
        function take(name, other) {
            if ((name, other) in includes) return
            includes[name, other]
            list[name] = list[name] " " other
            changed = 1
        }
        FILENAME ~ /\/sets$/ { sets[++number_of_sets] = $0; next }
        { name = FILENAME; all[name] }
        /^ *# *include *[<"]/ {
            split($0, part, /[<">]/)
            if (!(name in begins)) begins[name] = part[2]
            take(name, part[2])
            if (part[2] ~ /^spam\//) edge[name, part[2]]
        }
        END {
            do {
                changed = 0
                for (e in edge) {
                    split(e, end, SUBSEP)
                    some = split(list[end[2]], part, " ")
                    for (k = 1; k <= some; ++k) take(end[1], part[k])
                }
            } while (changed)
            for (name in all) {
                kind[name] = 0
                for (s = number_of_sets; s > 0; --s) {
                    some = split(sets[s], part, " ")
                    for (k = 1; k <= some && (name, part[k]) in includes; ++k) continue
                    if (k > some) kind[name] = s
                }
            }
            for (;;) {
                last = ""
                for (name in all)
                    if (last == "" || length(list[name]) > length(list[last])) last = name
                if (last == "") break
                chain = last
                delete all[last]
                do {
                    some = split(list[last], part, " ")
                    next_one = ""
                    for (k = 1; k <= some; ++k)
                        if ((part[k] in all) && kind[part[k]] == kind[last] &&
                            (next_one == "" || length(list[part[k]]) > length(list[next_one])))
                            next_one = part[k]
                    if (next_one == "") break
                    chain = next_one " " chain
                    delete all[next_one]
                    last = next_one
                } while (1)
                print kind[last], chain
            }
        }' "$work/sets" {} +)
}

precompile() { # compiler..., number of a set
    local number=${*: -1}
    sed -n "${number}p" "$work/sets" | tr ' ' '\n' | sed 's/.*/#include <&>/' >"$work/set$number.hpp"
    "${@:1:$#-1}" -x c++-header "$work/set$number.hpp" -o "$work/set$number.hpp.gch"
}

alone() { # number of compiler's words, compiler..., number of a set, headers of a chain
    local words=$1 first=()
    local compiler=("${@:2:words}") number=${*:words+2:1} headers=("${@:words+3}")
    if ((number > 0)); then first=(-include "$work/set$number.hpp"); fi
    printf '#include <%s>\n' "${headers[@]}" | "${compiler[@]}" "${first[@]}" -x c++ -fsyntax-only - || {
        echo "${headers[*]} does not compile by itself" >&2
        return 1
    }
}
export -f alone precompile
export work

chains | sort >"$work/chains"
awk '{ n += NF - 1 } END { print n " headers in " NR " runs of the compiler" }' "$work/chains"
cut -d ' ' -f 1 "$work/chains" | sort -u | sed '/^0$/d' |
    xargs -r -P 2 -L 1 bash -c 'precompile "$@"' precompile "${compile[@]}"
xargs -P 2 -L 1 bash -c 'alone "$@"' alone "${#compile[@]}" "${compile[@]}" <"$work/chains"
