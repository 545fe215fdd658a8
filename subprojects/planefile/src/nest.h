/* The head of a nest: a plane with windows, in which other planes of the file are shown.
 *
 * Each plane begins where the one before ends, and the last one ends with the file, so that none is
 * a part of another.
 */
#pragma once

#include "layout.h"

/* *size: the bytes of the head that begins so. NULL, or why it is refused. */
const char *pf_nest_begin(const unsigned char start[PF_NEST_BYTES], uint64_t file_size,
                          size_t *size);
/* A head of that size. ends: where each plane ends. NULL, or why it is refused. */
const char *pf_nest_check(const unsigned char *head, size_t size, uint64_t file_size,
                          uint64_t *ends);
