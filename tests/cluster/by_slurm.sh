#!/usr/bin/env bash
# A sweep as a Slurm job array of at most 1000 tasks (as many as clusters allow where nobody has said otherwise):
#   by_slurm.sh PROGRAM SWEEP OUT [OPTIONS OF SBATCH]          such as --time=1:00:00
set -euo pipefail
program="$1" sweep="$2" out="$3"
shift 3
chains="$("$program" sweep "$sweep" --show manifest | tail -n +2 | wc -l)"
each=$(((chains + 999) / 1000))
last=$(((chains - 1) / each))
sbatch --wait --array="0-$last" --output=/dev/null "$@" "$(dirname "$0")/job.sh" "$program" "$sweep" "$out" "$chains" "$each"
"$program" sweep collect "$out"
