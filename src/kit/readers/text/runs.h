/* Runs: characters of a line that have one direction and one script.
 *
 *   characters   a b c  D H 1 2 W  d       embeddings  0 0 0 1 1 2 2 1 0
 *   runs         [abc] [DH] [12] [W] [d]   reordered   [abc] [W] [12] [DH] [d]
 *
 * Odd embeddings run to the left.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

typedef struct cs_text_run {
  size_t begin, end; /* characters */
  uint8_t embedding;
} cs_text_run;

/* The known properties of each character of a text. */
typedef struct cs_run_characters {
  const uint32_t *characters, *scripts;
  const uint8_t *embeddings;
} cs_run_characters;

/* The runs of characters begin .. end - 1, in their order. Returns their number. A long run is cut
 * after a space, or anywhere if it has no space for a long time. runs: NULL, or room for them */
size_t cs_runs_find(const cs_run_characters *text, size_t begin, size_t end, cs_text_run *runs);
/* Puts the runs into visual order, from left to right. */
void cs_runs_reorder(cs_text_run *runs, size_t count);
