#!/usr/bin/env bash
# A sweep by HyperQueue, a task for each chain; a server and workers must run (hq server start, hq worker start):
#   by_hyperqueue.sh PROGRAM SWEEP OUT [OPTIONS OF HQ SUBMIT]  such as --time-limit=1h
set -euo pipefail
program="$1" sweep="$2" out="$3"
shift 3
chains="$("$program" sweep "$sweep" --show manifest | tail -n +2 | wc -l)"
hq submit --wait --array="0-$((chains - 1))" --cpus=1 --stdout=none --stderr=none "$@" \
    bash "$(dirname "$0")/job.sh" "$program" "$sweep" "$out" "$chains" 1
"$program" sweep collect "$out"
