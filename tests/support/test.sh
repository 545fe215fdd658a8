#!/usr/bin/env bash
# Begins a test for `meson test`, and prints its processor time.
#
#   tests/support/test.sh SETUP COMMAND...
#
# What is random is drawn by the seed in tests/seed, so that a test gives the same answer until the
# code changes. How much is tried, where the environment does not say otherwise:
#
#   setup            of 300 cases   one fault in   one other case in
#   part             80             6              3    without those tagged #full
#   full             80             6              1
#   all              300            1              1
#   part-sanitized   40             12             6    without those tagged #full
#   full-sanitized   40             12             6
#   all-sanitized    40             12             1
#
# Other cases are those of check_is_drawn in C and, with sanitizers, the tests of a spec.
#
# LeakSanitizer stops the threads of a process that ends and reads their memory; once in some
# thousands of processes it crashes there itself (issue 1353 of google/sanitizers). That says
# nothing about the test, which is then run a second time: its answer counts.
tool_fault='LeakSanitizer has encountered a fatal error'
show() { cat "$kept/out" && cat "$kept/err" >&2; }
run_sanitized() {
  kept=$(mktemp -d) || return
  trap 'rm -r "$kept"' EXIT
  trap 'show && exit 143' TERM # out of time
  for attempt in 1 2; do
    "$@" >"$kept/out" 2>"$kept/err"
    code=$?
    grep -qs "$tool_fault" "$kept/out" "$kept/err" || break
  done
  show
  [ "$attempt" = 1 ] || echo "# run twice: $tool_fault"
  return "$code"
}

run=
[[ $1 != *-sanitized ]] || run=run_sanitized
case $1 in
*-sanitized) scenes=40 faults=12 tests=6 ;;
part) scenes=80 faults=6 tests=3 ;;
all) scenes=300 faults=1 tests=1 ;;
*) scenes=80 faults=6 tests=1 ;;
esac
[[ $1 != part* ]] || export CELSPAN_PART=1
[ "$1" != all-sanitized ] || tests=1
export CELSPAN_SEED=${CELSPAN_SEED:-$(<"$(dirname "$0")/../seed")}
export CELSPAN_SCENES=${CELSPAN_SCENES:-$scenes} CELSPAN_FAULTS=${CELSPAN_FAULTS:-$faults}
export CELSPAN_TESTS=${CELSPAN_TESTS:-$tests}
shift
# It is meson's, for modules that are built earlier: a program must find its modules by itself.
unset LD_LIBRARY_PATH
TIMEFORMAT='%U + %S seconds of processor time'
time $run "$@"
