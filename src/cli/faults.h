/* The faults of many frames, folded: a line for each sentence, with the frames that it is true of.
 *
 *   frames 3-17, 20: cel 2, primitive 5: night.png: cannot be opened: No such file or directory
 *   frames 1, 3, 5, 7, 9, 11, 13, 15 and 4992 more up to 9999: shot.lua:7: ...
 *
 * INVARIANT  Memory follows what is told and not the frames: at most CS_FAULTS_MOST sentences, and
 * of each CS_FAULT_RUNS runs of frames; what is beyond that is counted.
 */
#ifndef CS_CLI_FAULTS_H
#define CS_CLI_FAULTS_H

#include "base/hash_table.h"
#include "cli/report.h"
#include "scene/inspect.h"

enum { CS_FAULTS_MOST = 1000, CS_FAULT_RUNS = 8 };

typedef struct cs_fault_run {
  int64_t first, last; /* both included */
} cs_fault_run;

typedef struct cs_fault_line {
  char *text;                   /* owned */
  char where[CS_INSPECT_PLACE]; /* the place in the scene where it was met first, "" for none */
  bool is_everywhere;           /* it was met at another place, too */
  cs_fault_run runs[CS_FAULT_RUNS];
  size_t run_count;
  uint64_t beyond;  /* frames outside of the runs */
  int64_t greatest; /* of those */
} cs_fault_line;

typedef struct cs_faults {
  celspan_context *context; /* borrowed */
  cs_exit outcome;          /* of the first fault; OK: there is none */
  cs_hash_table indices;    /* from sentences to indices into lines */
  cs_fault_line *lines;     /* in the order in which they were met first */
  size_t count, capacity;
  uint64_t met, beyond; /* faults in all; those whose sentence is not among the lines */
} cs_faults;

/* where: as cs_inspect_place, or "". Without memory a fault is counted, and has no line. */
void cs_faults_add(cs_faults *faults, int64_t frame, const char *where, const char *sentence,
                   cs_exit outcome);
/* Reports the lines as errors. */
void cs_faults_report(const cs_faults *faults);
void cs_faults_finish(cs_faults *faults);

#endif
