#!/usr/bin/env bash
# celspan farm on a private Grid Engine: the examples of docs/farm.md, an array with --task env and
# an array of lines of --commands, make the 240 frames that one run makes.
#
#   tests/farm/grid_engine.sh
#
# Needs Debian's gridengine-master, gridengine-exec and gridengine-client, root (as in a container),
# and build/celspan, or the program that CELSPAN names. Everything is in a temporary folder and on
# ports of its own; in the end it is stopped and removed.
. "$(dirname "$0")/engine.sh"
share=/usr/share/gridengine
lib=/usr/lib/gridengine
host=$(hostname)
export SGE_ROOT=$work/root SGE_CELL=cell SGE_ND=true # ND: no daemon leaves its shell
export SGE_QMASTER_PORT=$((20000 + RANDOM % 20000))
export SGE_EXECD_PORT=$((SGE_QMASTER_PORT + 1))
common=$SGE_ROOT/$SGE_CELL/common
spool=$work/spool

finish() {
  qconf -ke all >/dev/null 2>&1
  qconf -km >/dev/null 2>&1
  sleep 1
  finish_engine
}
trap finish EXIT

# ---------------------------------------------------------------- a Grid Engine of one machine

configure() {
  local place
  mkdir -p "$common" "$spool"/qmaster/job_scripts "$spool"/execd
  chmod 755 "$work"
  for place in bin lib util utilbin; do
    ln -s "/var/lib/gridengine/$place" "$SGE_ROOT/$place"
  done
  echo "$host" >"$common/act_qmaster"
  echo "$host localhost" >"$common/host_aliases" # both may be the name of 127.0.0.1
  cat >"$common/bootstrap" <<TEXT
admin_user none
default_domain none
ignore_fqdn true
spooling_method classic
spooling_lib libspoolc
spooling_params $common;$spool/qmaster
binary_path /usr/sbin
qmaster_spool_dir $spool/qmaster
security_mode none
listener_threads 2
worker_threads 2
scheduler_threads 1
TEXT
  sed "s|^execd_spool_dir.*|execd_spool_dir $spool/execd|; s|^min_uid.*|min_uid 0|
    s|^min_gid.*|min_gid 0|; s|^load_report_time.*|load_report_time 00:00:01|
    s|^mailer.*|mailer /bin/true|" "$share/default-configuration" >"$work/configuration"
  {
    "$lib/spoolinit" classic libspoolc "$common;$spool/qmaster" init &&
      "$lib/spooldefaults" configuration "$work/configuration" &&
      "$lib/spooldefaults" complexes "$share/util/resources/centry" &&
      "$lib/spooldefaults" usersets "$share/util/resources/usersets" &&
      "$lib/spooldefaults" managers root
  } >"$work/configure.log" 2>&1 || die "the cluster could not be made"
}

# wait_until COMMAND ...: at most a minute.
wait_until() {
  local i
  for ((i = 0; i < 60; i++)); do
    "$@" >/dev/null 2>&1 && return
    sleep 1
  done
  die "it took too long: $*"
}

# The template, as qconf prints it, for this machine, whatever its load is.
queue() {
  qconf -sq | sed "s/^qname.*/qname all.q/; s/^hostlist.*/hostlist $host/
    s/^slots.*/slots $(nproc)/; s/^load_thresholds.*/load_thresholds NONE/
    s/^pe_list.*/pe_list NONE/; s|^shell .*|shell /bin/sh|"
}

# The scheduler looks at once, and not every 15 seconds.
start() {
  sge_qmaster >"$work/qmaster.log" 2>&1 &
  processes+=($!)
  wait_until qconf -sh
  qconf -as "$host" >>"$work/configure.log" 2>&1
  sge_execd >"$work/execd.log" 2>&1 &
  processes+=($!)
  qconf -ssconf | sed 's/^schedule_interval.*/schedule_interval 0:0:1/
    s/^flush_submit_sec.*/flush_submit_sec 1/; s/^flush_finish_sec.*/flush_finish_sec 1/' \
    >"$work/scheduler"
  queue >"$work/queue"
  qconf -Msconf "$work/scheduler" >>"$work/configure.log" 2>&1
  qconf -Aq "$work/queue" >>"$work/configure.log" 2>&1 || die "there is no queue"
}

# ---------------------------------------------------------------- jobs

# The line of docs/farm.md that has qsub and this in it.
example() {
  local line
  line=$(grep 'qsub -t' "$root/docs/farm.md" | grep -F -- "$1") ||
    die "docs/farm.md has no such line"
  printf '%s\n' "$line"
}

is_empty() { [ -z "$(qstat)" ]; }

# run LINE FOLDER PREFIX: submits the line, waits for its tasks, and compares the frames.
run() {
  say "$1"
  PATH=$work:$PATH sh -c "$1" || die "qsub failed"
  until is_empty; do sleep 1; done
  same_frames "$2" "$3"
}

need sge_qmaster sge_execd qsub qconf qstat
configure
start
cd "$work" || exit 1
film
ln -s "$celspan" celspan
run "$(example '--task env')" out shot.
rm -r out
"$celspan" farm film.lua -o out/shot.####.png --commands --chunk 10 >job.txt || die "farm failed"
run "$(example 'job.txt')" out shot.
say "all checks passed"
