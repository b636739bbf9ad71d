#!/bin/bash
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
# EACH of the CHAINS of a sweep as a task of an array: job.sh PROGRAM SWEEP OUT CHAINS EACH. Slurm and HyperQueue number
# the tasks from 0. All share the folder OUT; a task that was killed is submitted again as it is.
first=$((${SLURM_ARRAY_TASK_ID:-$HQ_TASK_ID} * $5))
last=$((first + $5 < $4 ? first + $5 - 1 : $4 - 1))
exec "$1" sweep "$2" --chain "$first-$last" --out "$3" --threads 1
