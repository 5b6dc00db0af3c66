# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash disable=SC2034,SC2154,SC2164  # read by ./spam, under set -e
# Read by ./spam in a source tree: how programs come to be.
#
# A call goes through the steps packages - configure - build - run (or test, bench). Each step first
# finds out whether there is anything to do, so that a second call costs next to nothing, and each
# that fails says so through fail(). What a verb needs beyond this stands in verbs/<verb>.bash.

install=yes    # --no-install makes it no
preset=release # test --preset changes it

readonly set_up_failed=5 # exit status; those of a problem: src/docs/results.md

# By the names of Debian 12 and Ubuntu 24.04; each verb adds its own.
readonly build_packages=(g++ cmake ninja-build libsundials-dev libeigen3-dev libgsl-dev libcli11-dev
    libtomlplusplus-dev nlohmann-json3-dev libfmt-dev libhdf5-dev nettle-dev libfftw3-dev libboost-dev)
readonly picture_packages=(gnuplot-nox fonts-dejavu-core)

# --- steps -------------------------------------------------------------------------------------

step_log=''     # of the step that runs or ran last
step_command='' # likewise
at_work=''      # process group of the step that runs

log_of() { printf '%s/build/%s/spam-%s.log' "$root" "$preset" "$1"; }

# Keeps what a step prints in its log. The step is announced at the first line that matches
# `pattern`: a build that finds nothing to do stays silent. A terminal also shows the latest line.
follow() { # log, title, pattern
    local log=$1 title=$2 pattern=$3 line announced='' columns=80 start=$SECONDS
    if [[ -t 2 ]]; then read -r _ columns < <(stty size <&2) || true; fi
    ((columns > 3)) || columns=80
    while IFS= read -r line; do
        printf '%s\n' "$line" >&3
        [[ $line =~ $pattern ]] || continue
        [[ $announced ]] || say "$title (log: ${log#"$root"/})"
        announced=yes
        if [[ -t 2 ]]; then printf '\r\e[K  %s' "${line:0:columns-3}" >&2; fi
    done 3>"$log"
    [[ $announced ]] || return 0
    if [[ -t 2 ]]; then printf '\r\e[K' >&2; fi
    say "$title: $((SECONDS - start)) s"
}

# While it waits for a command in the foreground bash reacts to no signal. Here the command and all it
# starts are a process group of their own, which interrupted() ends.
watched() { # command...: its status is returned
    local status=0
    set -m
    "$@" </dev/null &
    at_work=$!
    set +m
    wait "$at_work" || status=$?
    at_work=''
    return "$status"
}

interrupted() { # word, status
    if [[ $at_work ]]; then
        kill -TERM -- "-$at_work" || true
        wait "$at_work" || true
    fi 2>/dev/null
    say "$1"
    exit "$2"
}

followed() { # title, pattern, command...
    local title=$1 pattern=$2
    shift 2
    (cd "$root" && exec "$@") 2>&1 | follow "$step_log" "$title" "$pattern"
}

step() { # name, title, pattern, command...: the command, in the root; its status is returned
    local name=$1
    step_log=$(log_of "$name")
    mkdir -p -- "${step_log%/*}"
    step_command=${*:4}
    if [[ $name == packages ]]; then
        followed "${@:2}" # sudo may ask for a password, and dpkg must not be ended half-way
    else
        watched followed "${@:2}"
    fi
}

excerpt() { # log: its first error with what is around, else its end
    local line
    line=$(grep -nE -m 1 'error:|^CMake Error|^E: ' -- "$1" | cut -d : -f 1 || true)
    if [[ $line ]]; then
        tail -n "+$((line > 4 ? line - 4 : 1))" -- "$1" | head -n 15
    else
        tail -n 15 -- "$1"
    fi
}

fail() { # step, what to do: after a step() that failed
    {
        printf '\nspam: %s failed\n' "$1"
        printf '  command: %s   (in %s)\n' "$step_command" "$root"
        printf '  log:     %s, where it says:\n' "$step_log"
        excerpt "$step_log" | cut -c 1-200 | sed 's/^/    | /' || true
        printf '  to do:   %s\n' "$2"
    } >&2
    exit "$set_up_failed"
}

stop() { # step, reason, what to do: before any command was run
    printf 'spam: %s failed: %s\n  to do:   %s\n' "$1" "$2" "$3" >&2
    exit "$set_up_failed"
}

# --- packages ----------------------------------------------------------------------------------

missing=() # packages, set by find_missing

find_missing() { # packages...
    local package present
    missing=()
    command -v dpkg-query >/dev/null || return 0
    # dpkg-query is not pleased with names it does not know, but still answers for the others.
    # shellcheck disable=SC2016  # a format of dpkg-query, not of the shell
    present=$(dpkg-query -W -f='${db:Status-Status} ${Package}\n' "$@" 2>/dev/null || true)
    for package in "$@"; do
        [[ $'\n'$present$'\n' == *$'\n'"installed $package"$'\n'* ]] || missing+=("$package")
    done
}

# Takes nothing away from the user's system: rather than remove a package, apt gives up.
readonly apt_install=(install -y --no-install-recommends --no-remove)

# What apt would do, in its own words. With --print-uris it needs no root and changes nothing; it
# fails when its lists do not know a package.
apt_plan() { LC_ALL=C apt-get "${apt_install[@]}" --print-uris "${missing[@]}" 2>&1; }

apt() { # title, arguments of apt-get...
    local title=$1 as_root=()
    shift
    ((EUID == 0)) || as_root=(sudo)
    # A machine that has just been started often updates itself: wait for dpkg's lock.
    step packages "$title" . "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C \
        apt-get -o DPkg::Lock::Timeout=600 -o Acquire::Retries=3 "$@"
}

install_packages() { # packages...
    local plan size by_hand
    command -v apt-get >/dev/null || install=no
    find_missing "$@"
    ((${#missing[@]})) || return 0
    [[ $install == yes ]] || return 0
    by_hand="apt-get install --no-install-recommends ${missing[*]}"
    say "packages to install: ${missing[*]}"
    if ((EUID != 0)) && ! command -v sudo >/dev/null; then
        stop packages "you are not root and there is no sudo" \
            "as root: $by_hand
           or, to try without them: ./spam --no-install ..."
    fi

    # Lists that are missing or too old are renewed, others left alone.
    if ! plan=$(apt_plan); then
        apt "asking the distribution for its packages" update || fail_packages "$by_hand"
        if ! plan=$(apt_plan); then
            printf '%s\n' "$plan" >>"$step_log"
            step_command=$by_hand
            fail_packages "$by_hand"
        fi
    fi
    size=$(grep -oE '[0-9]+ newly installed|^Need to get.*[^.]|^After this.*[^.]' <<<"$plan" || true)
    say "with what they depend on: ${size//$'\n'/; }"
    if [[ ${missing[*]} == *libsundials-dev* ]]; then
        say "(most of it is PETSc, Trilinos and MPI, which the SUNDIALS package depends on)"
    fi
    if ! apt "installing packages" "${apt_install[@]}" "${missing[@]}"; then
        # Old lists may name versions that the mirror has dropped.
        grep -q ' 404 ' "$step_log" || fail_packages "$by_hand"
        apt "asking the distribution for its packages" update || fail_packages "$by_hand"
        apt "installing packages again" "${apt_install[@]}" "${missing[@]}" ||
            fail_packages "$by_hand"
    fi
    missing=()
}

fail_packages() { # command by hand
    fail packages "check the network (Debian 12 and Ubuntu 24.04 or later have all packages), or
           as root: $1"
}

# A verb that needs a tool beyond the packages it has installed, or that were left to the user.
need() { # verb, tool, package of Debian
    command -v "$2" >/dev/null || stop "$1" "there is no $2" \
        "install the package $3 (on Debian and Ubuntu ./spam without --no-install does it)"
}

# --- configure and build -----------------------------------------------------------------------

in_ci() { [[ ${CI:-false} != false ]]; }

# One call at a time in a build directory; the others wait.
lock() {
    local folder=$root/build/$preset
    if ! mkdir -p "$folder" 2>/dev/null || ! [[ -w $folder ]]; then
        stop set-up "cannot write to $folder" \
            "make it yours (sudo chown -R $(id -un) $root/build) or use a clone of your own"
    fi
    exec 9>"$folder/spam.lock"
    flock --nonblock 9 && return
    say "another ./spam is at work in build/$preset; waiting for it"
    flock 9
}
unlock() { exec 9>&-; }

is_configured() { # KEY=VALUE...: does the build directory hold these already?
    local folder=$root/build/$preset setting
    [[ -f $folder/build.ninja && ! $root/CMakePresets.json -nt $folder/build.ninja ]] || return 1
    for setting in "$@"; do
        grep -q "^${setting%%=*}:[A-Z]*=${setting#*=}\$" "$folder/CMakeCache.txt" || return 1
    done
}

configure() { # KEY=VALUE...
    local cache=$root/build/$preset/CMakeCache.txt settings=("$@") arguments=() home setting part
    settings+=("CMAKE_COMPILE_WARNING_AS_ERROR=$(in_ci && echo ON || echo OFF)")

    # A tree that was copied or moved: its old build directory is of no use.
    home=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$cache" 2>/dev/null || true)
    if [[ $home && ! $home -ef $root ]]; then
        arguments+=(--fresh)
    elif is_configured "${settings[@]}"; then
        return 0
    fi
    # What a verb does not ask for stays as it is, so that `run` after `test` keeps the tests; the
    # first time it is off, so that `run` needs neither Boost.Test nor Google Benchmark, and compiles pair
    # sums for this processor only. To precompile headers takes as long as five programs to read them.
    if ! [[ -f $root/build/$preset/build.ninja ]]; then
        for part in SPAM_BUILD_TESTS=OFF SPAM_BUILD_BENCH=OFF SPAM_PRECOMPILE=OFF \
            "SPAM_LEVELS=$(level_of_processor)"; do
            [[ ${settings[*]} == *${part%%=*}=* ]] || settings+=("$part")
        done
    fi
    for setting in "${settings[@]}"; do arguments+=("-D$setting"); done

    if [[ -f $cache ]]; then cp -p "$cache" "$cache.before"; fi
    if ! step configure "configuring build/$preset" . cmake --preset "$preset" "${arguments[@]}"; then
        # A setting that failed is forgotten: it must not make the next `run` fail as well.
        if [[ -f $cache.before ]]; then mv "$cache.before" "$cache"; fi
        fail configure "$(configure_advice)"
    fi
    rm -f "$cache.before"
}

# Where pair sums are compared or timed they are compiled for every level of x86-64.
every_level() { if [[ $(uname -m) == x86_64 ]]; then echo 'v2;v3;v4'; else echo generic; fi; }

# As best_of_processor() in src/core/instruction_set.cpp has it.
level_of_processor() {
    local flags level=v4 flag
    flags=$(sed -n '/^flags/{s/$/ /p;q}' /proc/cpuinfo 2>/dev/null || true)
    if [[ $(uname -m) != x86_64 || -z $flags ]]; then every_level && return; fi
    for flag in avx512f avx512bw avx512cd avx512dq avx512vl; do [[ $flags == *" $flag "* ]] || level=v3; done
    for flag in avx2 fma bmi1 bmi2; do [[ $flags == *" $flag "* ]] || level=v2; done
    echo "$level"
}

configure_advice() {
    if ((${#missing[@]})); then
        echo "install what is missing: ${missing[*]}
           (these are the names of Debian and Ubuntu; there ./spam without --no-install does it)"
    else
        echo "mend the error above; if it makes no sense, rm -r $root/build/$preset and try again"
    fi
}

build() { # targets...
    local jobs
    # nproc would take OMP_NUM_THREADS for the number of processors.
    jobs=${CMAKE_BUILD_PARALLEL_LEVEL:-$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc)}
    step build "building in build/$preset" 'Building|Linking' \
        cmake --build --preset "$preset" -j "$jobs" --target "$@" ||
        fail build "mend the error above. A compiler that was 'Killed' had too little memory:
           try again with CMAKE_BUILD_PARALLEL_LEVEL=1 in the environment"
}

set_up() { # <packages...> -- <KEY=VALUE...> -- <targets...>
    local packages=() settings=()
    while [[ $1 != -- ]]; do packages+=("$1") && shift; done
    shift
    while [[ $1 != -- ]]; do settings+=("$1") && shift; done
    shift
    lock
    # Any gnuplot will do, and one put there by hand is as good.
    command -v gnuplot >/dev/null || packages+=("${picture_packages[@]}")
    install_packages "${build_packages[@]}" "${packages[@]}"
    configure "${settings[@]}"
    build "$@"
    unlock
}

# --- programs ----------------------------------------------------------------------------------

# Whether a program is newer than all it is made of, and than the last commit, which it names: then it runs
# without waiting for another ./spam, and for users who may not write to the build directory.
is_up_to_date() { # program, parts in the root...
    local parts=(CMakeLists.txt CMakePresets.json "${@:2}")
    [[ -x $1 ]] || return 1
    if [[ -w $root/build/$preset && -f $root/.git/logs/HEAD ]]; then parts+=(.git/logs/HEAD); fi
    [[ -z $(cd -- "$root" && find "${parts[@]}" -newer "$1" -print -quit) ]]
}

# Builds the program of a target and becomes it: it gets the signals, and its exit status is ours.
become() { # verb, target, program, how many parts, parts..., arguments...
    local verb=$1 target=$2 program=$root/build/$preset/$3 parts=("${@:5:$4}")
    shift "$((4 + $4))"
    if is_up_to_date "$program" "${parts[@]}"; then exec "$program" "$@"; fi
    set_up -- -- "$target"
    [[ -x $program ]] || stop "$verb" "the build left no $program" "rm -r $root/build/$preset and try again"
    exec "$program" "$@"
}

trap 'interrupted "interrupted" 130' INT
trap 'interrupted "terminated" 143' TERM
trap 'interrupted "terminal closed" 129' HUP
