#!/bin/sh
#SBATCH --array=0-255
#SBATCH --cpus-per-task=4
#SBATCH --time=00:30:00
#SBATCH --requeue
export RAYON_NUM_THREADS=$SLURM_CPUS_PER_TASK
i=$SLURM_ARRAY_TASK_ID
exec rasterproof exhaust edges --subpixel-bits 8 --shard "$i/256" \
    --checkpoint "$SCRATCH/edges-$i.checkpoint" -o "$SCRATCH/edges-$i.json"
