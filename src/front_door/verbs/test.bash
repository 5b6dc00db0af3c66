# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash disable=SC2034,SC2154,SC2164  # read by ./spam, under set -e
#|  ./spam test [--preset release|dev|tsan|coverage] [ctest options]
#|                                    build everything and run the tests; with -L hunt those that try
#|                                    random inputs for an hour, with -L long runs of minutes

readonly test_packages=(libboost-test-dev)
# For the tests of style and of instruction counts; benchmarks are compiled, so that they go on to compile.
readonly ci_packages=(clang-format valgrind shellcheck libbenchmark-dev)
readonly sanitizer_packages=(clang libclang-rt-dev)

verb_test() { # [--no-install] [--preset P] [ctest options...]
    local options=() packages=("${test_packages[@]}") jobs status=0
    local parts=(SPAM_BUILD_TESTS=ON SPAM_PRECOMPILE=ON "SPAM_LEVELS=$(every_level)")
    while (($#)); do
        case $1 in
        --no-install) install=no ;;
        --preset=*) preset=${1#*=} ;;
        --preset)
            preset=${2-}
            shift $(($# > 1))
            ;;
        *) options+=("$1") ;;
        esac
        shift
    done
    case $preset in
    release | coverage) ;;
    dev | tsan) packages+=("${sanitizer_packages[@]}") ;;
    *) refuse "test: no preset '$preset'; there are release, dev, tsan and coverage" ;;
    esac
    # Of a configuration of their own: no other call runs them.
    if [[ " ${options[*]} " == *" -L "@(hunt|long)" "* ]]; then options+=(-C hunt); fi
    if in_ci; then packages+=("${ci_packages[@]}") parts+=(SPAM_BUILD_BENCH=ON); fi
    set_up "${packages[@]}" -- "${parts[@]}" -- all
    jobs=$(env -u OMP_NUM_THREADS -u OMP_THREAD_LIMIT nproc)
    cd -- "$root"
    watched ctest --preset "$preset" --output-on-failure -j "$jobs" "${options[@]}" || status=$?
    ((status == 0)) || say "test failed (ctest --preset $preset: status $status)
  log:     $root/build/$preset/Testing/Temporary/LastTest.log
  to do:   the failed ones again: ./spam test --preset $preset --rerun-failed"
    exit "$status"
}
