#include "cli/faults.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---------------------------------------------------------------- runs of frames */

static bool touches(const cs_fault_run *run, int64_t first, int64_t last) {
  return first <= run->last + 1 && last >= run->first - 1;
}

/* Joins run i with another that it now touches. */
static void join_runs(cs_fault_line *line, size_t i) {
  for (size_t k = 0; k < line->run_count; k++) {
    cs_fault_run *run = &line->runs[i], *other = &line->runs[k];
    if (k == i || !touches(run, other->first, other->last))
      continue;
    run->first = run->first < other->first ? run->first : other->first;
    run->last = run->last > other->last ? run->last : other->last;
    *other = line->runs[--line->run_count];
    return;
  }
}

static bool has_frame(const cs_fault_line *line, int64_t frame) {
  for (size_t i = 0; i < line->run_count; i++)
    if (frame >= line->runs[i].first && frame <= line->runs[i].last)
      return true;
  return false;
}

static void add_frame(cs_fault_line *line, int64_t frame) {
  for (size_t i = 0; i < line->run_count; i++)
    if (touches(&line->runs[i], frame, frame)) {
      cs_fault_run *run = &line->runs[i];
      run->first = frame < run->first ? frame : run->first;
      run->last = frame > run->last ? frame : run->last;
      join_runs(line, i);
      return;
    }
  if (line->run_count < CS_FAULT_RUNS) {
    line->runs[line->run_count++] = (cs_fault_run){frame, frame};
    return;
  }
  line->greatest = line->beyond == 0 || frame > line->greatest ? frame : line->greatest;
  line->beyond++;
}

/* ---------------------------------------------------------------- lines */

static cs_hash hash_of(const char *sentence) {
  cs_hash hash = cs_hash_begin(0);
  cs_hash_text(&hash, sentence);
  return cs_hash_end(hash);
}

static cs_fault_line *new_line(cs_faults *faults, cs_hash key, const char *where,
                               const char *sentence) {
  celspan_context *context = faults->context;
  size_t size = strlen(sentence) + 1;
  if (faults->count == CS_FAULTS_MOST ||
      cs_mem_reserve(context, (void **)&faults->lines, &faults->capacity, faults->count + 1,
                     sizeof *faults->lines) != CELSPAN_OK ||
      cs_hash_table_add(&faults->indices, context, key, faults->count) != CELSPAN_OK)
    return NULL;
  char *text = cs_mem_resize(context->memory, NULL, 0, size);
  if (!text)
    return NULL;
  cs_fault_line *line = &faults->lines[faults->count++];
  *line = (cs_fault_line){.text = memcpy(text, sentence, size)};
  snprintf(line->where, sizeof line->where, "%s", where);
  return line;
}

static cs_fault_line *line_of(cs_faults *faults, const char *where, const char *sentence) {
  cs_hash key = hash_of(sentence);
  size_t index;
  if (!cs_hash_table_find(&faults->indices, key, &index) || index >= faults->count)
    return new_line(faults, key, where, sentence);
  return &faults->lines[index];
}

void cs_faults_add(cs_faults *faults, int64_t frame, const char *where, const char *sentence,
                   cs_exit outcome) {
  cs_fault_line *line = line_of(faults, where, sentence);
  faults->met++;
  if (faults->outcome == CS_EXIT_OK)
    faults->outcome = outcome;
  if (!line) {
    faults->beyond++;
    return;
  }
  line->is_everywhere |= strcmp(line->where, where) != 0;
  if (!has_frame(line, frame))
    add_frame(line, frame);
}

/* ---------------------------------------------------------------- the report */

static int in_order(const void *a, const void *b) {
  const cs_fault_run *one = a, *other = b;
  return (one->first > other->first) - (one->first < other->first);
}

/* "frame 3", "frames 3-17, 20 and 5 more up to 99". */
static void list_frames(const cs_fault_line *line, char *out, size_t size) {
  cs_fault_run runs[CS_FAULT_RUNS];
  memcpy(runs, line->runs, sizeof runs);
  qsort(runs, line->run_count, sizeof *runs, in_order);
  bool is_one = line->run_count == 1 && runs[0].first == runs[0].last && line->beyond == 0;
  size_t length = (size_t)snprintf(out, size, "frame%s", is_one ? "" : "s");
  for (size_t i = 0; i < line->run_count; i++) {
    length +=
        (size_t)snprintf(out + length, size - length, "%s %" PRId64, i ? "," : "", runs[i].first);
    if (runs[i].last > runs[i].first)
      length += (size_t)snprintf(out + length, size - length, "-%" PRId64, runs[i].last);
  }
  if (line->beyond > 0)
    snprintf(out + length, size - length, " and %" PRIu64 " more up to %" PRId64, line->beyond,
             line->greatest);
}

void cs_faults_report(const cs_faults *faults) {
  enum { FRAMES = (CS_FAULT_RUNS + 1) * 2 * 24 + 64 };
  char frames[FRAMES];
  for (size_t i = 0; i < faults->count; i++) {
    const cs_fault_line *line = &faults->lines[i];
    list_frames(line, frames, sizeof frames);
    cs_report_error("%s: %s%s%s%s", frames, line->where,
                    line->is_everywhere ? ", and elsewhere" : "", line->where[0] ? ": " : "",
                    line->text);
  }
  if (faults->beyond > 0)
    cs_report_error("%" PRIu64 " more with other sentences are not listed: give --frames to look "
                    "at fewer frames",
                    faults->beyond);
}

void cs_faults_finish(cs_faults *faults) {
  cs_memory *memory = faults->context->memory;
  for (size_t i = 0; i < faults->count; i++)
    cs_mem_free(memory, faults->lines[i].text, strlen(faults->lines[i].text) + 1);
  cs_mem_free(memory, faults->lines, faults->capacity * sizeof *faults->lines);
  cs_hash_table_finish(&faults->indices, faults->context);
  *faults = (cs_faults){.context = faults->context};
}
