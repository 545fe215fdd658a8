#!/usr/bin/env bash
# celspan farm on a private Slurm: an array of frames, one task of which is killed and put back into
# the queue, and a large frame in strips, joined, that equals the one made whole.
#
#   tests/farm/slurm.sh [SIDE]       pixels of the large frame's side; 100000, at least 20480. It is
#                                    a span file; a PNG of a fifth of that side, in 16 strips, is
#                                    unpacked and compared
#
# Needs Debian's slurmctld, slurmd and munge, root (as in a container), and build/celspan, or the
# program that CELSPAN names. Everything is in a temporary folder and on ports of its own; in the
# end it is stopped and removed.
. "$(dirname "$0")/engine.sh"
side=${1:-100000}
ports=$((20000 + RANDOM % 20000))

finish() {
  scancel --user=root >/dev/null 2>&1
  sleep 1
  finish_engine
}
trap finish EXIT

# ---------------------------------------------------------------- a Slurm of one machine

configure() {
  local name
  name=$(hostname -s)
  mkdir -p "$work"/{state,spool,run}
  chmod 755 "$work"
  head -c 1024 /dev/urandom >"$work/munge.key"
  chmod 400 "$work/munge.key"
  cat >"$work/slurm.conf" <<TEXT
ClusterName=celspan
SlurmctldHost=$name(127.0.0.1)
SlurmctldPort=$ports
SlurmdPort=$((ports + 1))
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$work/run/munge.socket
CredType=cred/munge
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/run/slurmctld.pid
SlurmdPidFile=$work/run/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerType=sched/backfill
ReturnToService=2
SlurmdTimeout=300
RebootProgram=/bin/false
NodeName=$name NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$name Default=YES MaxTime=INFINITE State=UP
TEXT
  export SLURM_CONF=$work/slurm.conf CELSPAN=$celspan
}

start() {
  munged --foreground --force --key-file="$work/munge.key" --socket="$work/run/munge.socket" \
    --pid-file="$work/run/munge.pid" --seed-file="$work/run/munge.seed" \
    --log-file="$work/munge.log" >"$work/munged.log" 2>&1 &
  processes+=($!)
  sleep 1
  slurmctld -D >"$work/ctld.log" 2>&1 &
  processes+=($!)
  slurmd -D >"$work/d.log" 2>&1 &
  processes+=($!)
  for ((i = 0; i < 60; i++)); do
    [ "$(sinfo -h -o %T 2>/dev/null)" = idle ] && return
    sleep 1
  done
  die "Slurm did not start"
}

# ---------------------------------------------------------------- jobs

# How many tasks of a job are left, without those that Slurm forgot.
left() { squeue -h -r -j "$1" 2>/dev/null | wc -l; }

wait_for() {
  while [ "$(left "$1")" -gt 0 ]; do sleep 1; done
}

number_of() { sed -n 's/.*Submitted batch job //p' | head -n 1; }

# The state of a task, as long as Slurm remembers it.
state_of() { scontrol show job "$1" | grep -o 'JobState=[A-Z_]*\|Restarts=[0-9]*' | tr '\n' ' '; }

# ---------------------------------------------------------------- what is shown

# Kills the celspan of a task while it runs, not the script that called it.
kill_task() {
  local process
  for process in $(pgrep -f -- "--task $1"); do
    [ "$(readlink "/proc/$process/exe")" = "$celspan" ] && kill -KILL "$process" && return
  done
  return 1
}

# 240 frames in 24 tasks. While one runs, its celspan is killed: the task goes back into the queue.
array() {
  local job restarts
  say "an array of 24 tasks, one of them killed"
  "$celspan" farm film.lua -o 'shots of film/####.png' --slurm --chunk 10 --workers 1 \
    --logs 'logs of it' >array.sh || die "farm failed"
  job=$(bash array.sh | number_of)
  [ -n "$job" ] || die "the array was not put into the queue"
  until kill_task 2/24; do
    [ "$(left "$job")" -gt 0 ] || die "task 2 was never seen"
  done
  wait_for "$job"
  restarts=$(state_of "${job}_2")
  say "task 2: $restarts"
  case $restarts in *COMPLETED*Restarts=1*) ;; *) die "task 2 was not put back" ;; esac
  same_frames "shots of film"
  say "$(find 'logs of it' -name '*.log' | wc -l) logs"
}

# strips ENDING SIDE: a frame of SIDE pixels a side in 16 strips.
strips() {
  local ending=$1 side=$2 job jobs
  say "a frame of $side x $side in 16 strips: $ending"
  "$celspan" farm film.lua -o "large.$ending" --frames 1 --size "${side}x$side" --slurm \
    --strips 16 --workers 1 >"strips.sh" || die "farm failed"
  SECONDS=0
  bash strips.sh >jobs.txt || die "the strips were not put into the queue"
  mapfile -t jobs < <(sed -n 's/Submitted batch job //p' jobs.txt)
  for job in "${jobs[@]}"; do wait_for "$job"; done
  [ -f "large.$ending" ] || die "the strips were not joined"
  say "made and joined in $SECONDS s"
  SECONDS=0
  "$celspan" render film.lua -o "whole.$ending" --frames 1 --size "${side}x$side" --progress none ||
    die "render failed"
  say "made whole in $SECONDS s"
  SECONDS=0
  "$celspan" join "large.$ending".strips/{1..16}."$ending" -o "again.$ending" || die "join failed"
  say "joined once more in $SECONDS s"
  if [ "$ending" = png ]; then
    same_pictures "large.$ending" "whole.$ending"
  else
    cmp "large.$ending" "whole.$ending" || die "the frames differ"
    say "the same bytes: $(stat -c %s "large.$ending")"
  fi
  rm -rf "large.$ending"* "whole.$ending" "again.$ending"
}

# Compares with a reader that shares no code with celspan and keeps only two rows in memory.
same_pictures() {
  cc -O2 -o png_sums "$root/tests/farm/png_sums.c" -lz || die "no compiler"
  ./png_sums "$1" >one.txt || die "$1 cannot be read"
  ./png_sums "$2" >two.txt || die "$2 cannot be read"
  cmp one.txt two.txt || die "the pictures differ"
  say "the same pixels: $(cat one.txt); $(stat -c %s "$1") and $(stat -c %s "$2") bytes"
}

need munged slurmctld slurmd sbatch
configure
start
cd "$work" || exit 1
film
array
strips span "$side"
strips png $((side / 5))
say "all checks passed"
