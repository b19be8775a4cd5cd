#!/bin/sh
# Says of a Slurm job whether it is running, was a success or has failed: sh status.sh JOBID
# A job that nobody knows any more counts as failed, and is done again.
state=$(scontrol -o show job "$1" 2>/dev/null | sed -nE 's/.*JobState=([A-Z_]+).*/\1/p' | head -n 1)
if [ -z "$state" ]; then
  state=$(sacct -X -n -P -o State -j "$1" 2>/dev/null | head -n 1 | cut -d ' ' -f 1)
fi
case $state in
  COMPLETED) echo success ;;
  PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | REQUEUED | REQUEUE_HOLD | RESIZING | STAGE_OUT | STOPPED | SPECIAL_EXIT)
    echo running
    ;;
  '')
    # slurmctld may be away for a moment: then nothing is known, and the job goes on.
    if scontrol ping 2>/dev/null | grep -q ' is UP'; then echo failed; else echo running; fi
    ;;
  *) echo failed ;;
esac
