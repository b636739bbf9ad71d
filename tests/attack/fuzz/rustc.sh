#!/bin/sh
# What cargo calls instead of rustc: edge counters, compared operands and checks of overflow in the crates that parse.
rustc="$1"
shift
case " $* " in
*" --crate-name asperity_"* | *" --crate-name toml "* | *" --crate-name fuzz "*)
    case " $* " in
    *build.rs*) ;;
    *)
        exec "$rustc" "$@" -Coverflow-checks=on -Cpasses=sancov-module \
            -Cllvm-args=-sanitizer-coverage-level=3 \
            -Cllvm-args=-sanitizer-coverage-inline-8bit-counters \
            -Cllvm-args=-sanitizer-coverage-pc-table \
            -Cllvm-args=-sanitizer-coverage-trace-compares
        ;;
    esac
    ;;
esac
exec "$rustc" "$@"
