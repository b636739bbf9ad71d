#!/usr/bin/env bash
# kill -9 at ten random moments, each followed by --resume: the table is that of an undisturbed run, byte for byte.
#   tests/cluster/kill.sh PROGRAM [SWEEP [SEED]]
set -euo pipefail
here="$(cd "$(dirname "$0")" && pwd)"
program="$(realpath "$1")"
sweep="$(realpath "${2:-$here/tiny.toml}")"
seed="${3:-$$}"
RANDOM=$seed
folder="$(mktemp -d)"
trap 'rm -rf "$folder"' EXIT
cd "$folder"
started="$(date +%s%N)"
"$program" sweep "$sweep" --out single --threads 2 >/dev/null
whole_ms=$((($(date +%s%N) - started) / 1000000))
echo "undisturbed: $whole_ms ms; seed $seed"
killed=0
# Moments spread over the length of the whole run, so that the run as a whole is hit everywhere.
while [ "$killed" -lt 10 ]; do
    "$program" sweep "$sweep" --out killed --threads 2 --resume >/dev/null 2>&1 &
    pid=$!
    wait_ms=$((1 + (RANDOM * 32768 + RANDOM) % (whole_ms / 4)))
    sleep "$(printf '%d.%03d' $((wait_ms / 1000)) $((wait_ms % 1000)))"
    if kill -9 "$pid" 2>/dev/null; then
        killed=$((killed + 1))
        echo "killed after $wait_ms ms with $(find killed/cases -name '*.json' 2>/dev/null | wc -l) cases there"
    fi
    wait "$pid" 2>/dev/null || true
    if [ -e killed/table.csv ]; then
        # Done before all kills were used up: begin anew.
        cmp killed/table.csv single/table.csv
        rm -r killed
    fi
done
"$program" sweep "$sweep" --out killed --threads 2 --resume >/dev/null
cmp killed/table.csv single/table.csv && echo "same: killed ten times, resumed"
