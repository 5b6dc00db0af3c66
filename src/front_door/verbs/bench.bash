# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash disable=SC2034,SC2154,SC2164  # read by ./spam, under set -e
#|  ./spam bench [options]            build and run the benchmarks (options of Google Benchmark)

readonly bench_packages=(libbenchmark-dev)

benchmark_options='list_tests|filter|min_time|min_warmup_time|repetitions|enable_random_interleaving'
benchmark_options+='|report_aggregates_only|display_aggregates_only|format|out|out_format|color'
benchmark_options+='|counters_tabular|context|time_unit|perf_counters'

verb_bench() { # [options of Google Benchmark...]
    local program=$root/build/$preset/tests/bench/spam_bench option
    for option in "$@"; do
        [[ $option == --help || $option =~ ^--benchmark_($benchmark_options)(=|$) ]] ||
            refuse "bench: '$option' is no option of Google Benchmark; these are --benchmark_ and one of ${benchmark_options//|/, }"
    done
    set_up "${bench_packages[@]}" -- SPAM_BUILD_BENCH=ON "SPAM_LEVELS=$(every_level)" -- spam_bench
    [[ -x $program ]] || stop bench "the build left no $program" "rm -r $root/build/$preset and try again"
    exec "$program" "$@"
}
