#!/bin/bash
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
# One shard of a sweep: sbatch --array=1-N job.sh PROGRAM SWEEP OUT N. All shards share the folder OUT; a job that
# was killed is submitted again as it is.
exec "$1" sweep "$2" --shard "$SLURM_ARRAY_TASK_ID/$4" --out "$3" --resume --threads 1
