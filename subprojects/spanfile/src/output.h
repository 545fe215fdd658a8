/* Where the records of a file go: a buffer before `write`, and the index of key rows.
 *
 *   key rows --> node of level 0 --full--> node of level 1 --full--> ...
 *                512 entries               an entry for each node below
 *
 * INVARIANT: memory does not grow with the height. A node of the index is written when it is full.
 * Functions that return false could not write.
 */
#pragma once

#include "store.h"

enum { SF_HEAD_BYTES = 1 + SF_LENGTH_BYTES };

/* Completes a record with kind and length before the payload, where there are SF_HEAD_BYTES of
 * room, and the checksum after it, where there are SF_CHECK_BYTES. Returns the whole size; *start:
 * where it begins. */
size_t sf_record_seal(unsigned char *payload, size_t payload_size, unsigned char kind, uint32_t row,
                      unsigned char **start);

typedef struct sf_output sf_output;

/* NULL: no memory. The header of the file is in the buffer. */
sf_output *sf_output_create(const sf_memory *memory, const spanfile_writer_desc *desc);
void sf_output_destroy(const sf_memory *memory, sf_output *out); /* NULL is ignored */
uint64_t sf_output_position(const sf_output *out);
bool sf_output_put(sf_output *out, const void *bytes, size_t size);
/* The record that comes next is that of a key row. */
bool sf_output_key(sf_output *out, uint32_t row);
/* Index and trailer, and all bytes to `write`. */
bool sf_output_end(sf_output *out, const spanfile_info *info);
