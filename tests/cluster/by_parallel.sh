#!/usr/bin/env bash
# A sweep by GNU parallel, a task for each chain, the longest first, as many at a time as there are cores:
#   by_parallel.sh PROGRAM SWEEP OUT [OPTIONS OF PARALLEL]     such as --sshloginfile HOSTS, for machines that share OUT
set -euo pipefail
program="$1" sweep="$2" out="$3"
shift 3
"$program" sweep "$sweep" --show manifest | tail -n +2 | sort -t , -k 4,4gr | cut -d , -f 1 |
    parallel "$@" "$program" sweep "$sweep" --chain {} --out "$out" --threads 1
"$program" sweep collect "$out"
