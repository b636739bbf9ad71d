#!/bin/sh
# Coverage-guided fuzzing of a parser, by one command with stable Rust and a C++ compiler:
#
#     tests/attack/fuzz/fuzz.sh PARSER SECONDS [libFuzzer's options]
#     tests/attack/fuzz/fuzz.sh PARSER merge
#
# PARSER: scene set sweep csv npy state recording notes. It begins from the inputs in tests/attack/corpus/PARSER and keeps
# what it finds in target/fuzz/corpus/PARSER; an input that fails lies in target/fuzz afterwards. `merge` puts the least
# set of the short ones that reaches as much into tests/attack/corpus/PARSER, which `--test attack` gives to the program.
set -eu
cd "$(dirname "$0")"
parser="$1" seconds="$2"
shift 2
root="$(cd ../../.. && pwd)"
target="$root/target/fuzz"
kept="$root/tests/attack/corpus/$parser"
found="$target/corpus/$parser"
mkdir -p "$found" "$kept"
# The dependencies of the program, and the fuzzer's own on top.
cp "$root/Cargo.lock" Cargo.lock
RUSTC_WRAPPER="$PWD/rustc.sh" cargo build --release --target-dir "$target"
set -- -timeout=20 -rss_limit_mb=2000 -max_len=32768 "-artifact_prefix=$target/" "$@"
export ASPERITY_FUZZ="$parser"
if [ "$seconds" = merge ]; then
    short="$(mktemp -d)"
    find "$found" "$kept" -type f -size -1000c -exec cp {} "$short" \;
    rm -rf "$kept"
    mkdir "$kept"
    "$target/release/fuzz" -set_cover_merge=1 -use_counters=0 "$@" "$kept" "$short"
    rm -rf "$short"
else
    "$target/release/fuzz" "-max_total_time=$seconds" -print_final_stats=1 "$@" "$found" "$kept"
fi
