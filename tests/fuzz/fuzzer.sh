#!/usr/bin/env bash
# Runs fuzz targets of a build with the option `fuzz`, one after the other, each for its share of
# the time, and prints how often each was executed and what was found.
#
#   tests/fuzz/fuzzer.sh BUILD FOLDER SECONDS [TARGET...]
#
# Run it from the root of the tree. FOLDER receives, by the target's name, the bytes of each
# finding, its log, and under learned/ the inputs with which the next run begins, in addition to the
# corpus. Exit code 1: there are findings in celspan. A finding inside another library, without a
# line of celspan above it, is listed, and the target continues.
set -u
build=$1 folder=$2 seconds=$3
shift 3
# A small quarantine makes runs of small inputs several times as fast.
export ASAN_OPTIONS=allocator_may_return_null=1:detect_leaks=0:handle_abort=1
ASAN_OPTIONS+=:quarantine_size_mb=8
export UBSAN_OPTIONS=print_stacktrace=1:halt_on_error=1
export LSAN_OPTIONS="suppressions=$PWD/tests/support/lsan.supp:print_suppressions=0"

# Each folder of the corpus is a target; its program is named like the folder, up to the first "-".
# The subprojects' are elsewhere.
program_of() {
  if [ -d "subprojects/$1" ]; then
    echo "$build/subprojects/$1/tests/fuzz_reader"
  else
    echo "$build/tests/fuzz/fuzz_${1%%-*}"
  fi
}

corpus_of() {
  if [ -d "subprojects/$1" ]; then
    echo "subprojects/$1/corpus"
  else
    echo "tests/fuzz/corpus/$1"
  fi
}

# Whether the first frame of the log's first stack, outside the sanitizer and the C and C++
# libraries, lies in a system library. Lua's counts as celspan's: its frames do celspan's own work.
is_foreign() {
  awk '
    $1 ~ /^#[0-9]+$/ && $3 == "in" {
      if ($0 ~ /compiler-rt|__asan|__sanitizer|__interceptor|fuzzer::|operator (new|delete)/) next
      if ($4 ~ /^(malloc|calloc|realloc)$/) next
      if ($0 ~ /\/(libc|libm|libstdc\+\+|libgcc_s)[.-]/) next
      foreign = $0 ~ /\(\/(usr\/)?lib\// && $0 !~ /liblua/
      exit
    }
    END { exit !foreign }' "$1"
}

# fuzz_once NAME SECONDS: one run of libFuzzer, to its end or to a finding. Its processor time is in
# NAME.time.
fuzz_once() {
  local name=$1 share=$2 status TIMEFORMAT='%U %S'
  {
    time "$(program_of "$name")" -max_total_time="$share" -timeout=60 -detect_leaks=0 \
      -rss_limit_mb=3072 -malloc_limit_mb=2048 -print_final_stats=1 \
      -artifact_prefix="$folder/$name-" "$folder/learned/$name" "$(corpus_of "$name")" \
      >"$folder/$name.log" 2>&1
    status=$?
  } 2>"$folder/$name.time"
  return $status
}

executions_in() { awk '/^stat::number_of_executed_units/ { n = $2 } END { print n + 0 }' "$1"; }

hundredths_in() { awk '{ n = 100 * ($1 + $2) } END { printf "%d", n }' "$1"; }

# The file that a log names as written, or the log itself.
finding_in() {
  local file
  file=$(awk '/Test unit written to/ { print $NF }' "$1" | tail -1)
  echo "${file:-$1}"
}

own=0

# fuzz NAME SECONDS: until the time is over or there is a finding in celspan itself.
fuzz() {
  local name=$1 end=$((SECONDS + $2)) runs=0 spent=0 foreign=0 found='' is_done=false file log
  mkdir -p "$folder/learned/$name"
  while [ "$SECONDS" -lt "$end" ] && [ -z "$found" ] && ! $is_done; do
    fuzz_once "$name" $((end - SECONDS)) && is_done=true
    runs=$((runs + $(executions_in "$folder/$name.log")))
    spent=$((spent + $(hundredths_in "$folder/$name.time")))
    $is_done && break
    file=$(finding_in "$folder/$name.log")
    log=$folder/$(basename "$file" .log).log
    [ "$log" -ef "$folder/$name.log" ] || mv "$folder/$name.log" "$log"
    if is_foreign "$log"; then
      foreign=$((foreign + 1))
      printf '   %s: in another library: %s\n' "$name" "$file"
    else
      found=$file
    fi
  done
  rm -f "$folder/$name.time"
  printf '%-14s %10d executions in %d s of processor time, %d findings' "$name" "$runs" \
    $((spent / 100)) "$([ -z "$found" ] && echo 0 || echo 1)"
  [ "$foreign" = 0 ] || printf ', %d in other libraries' "$foreign"
  printf '\n'
  if [ -n "$found" ]; then
    own=$((own + 1))
    printf '   %s\n' "$found"
  fi
}

targets=("$@")
if [ "${#targets[@]}" = 0 ]; then
  mapfile -t targets < <(find tests/fuzz/corpus -mindepth 1 -maxdepth 1 -type d -printf '%f\n' |
    sort)
  targets+=(spanfile planefile)
fi
for target in "${targets[@]}"; do
  [ -x "$(program_of "$target")" ] || {
    echo "fuzz: there is no target '$target' in $build" >&2
    exit 2
  }
done
for target in "${targets[@]}"; do
  fuzz "$target" $((seconds / ${#targets[@]} > 0 ? seconds / ${#targets[@]} : 1))
done
[ "$own" = 0 ]
