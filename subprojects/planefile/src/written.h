/* The records that a film has already, by prints of their payloads.
 *
 * INVARIANT: payloads with one print are taken to be the same. A print has 128 bits and the size:
 * no two of the records that a disk can hold have one by chance.
 */
#pragma once

#include "layout.h"

typedef struct pf_print {
  uint64_t words[2], size;
} pf_print;

/* kind: makes prints of other kinds differ. */
pf_print pf_print_of(const unsigned char *bytes, size_t size, uint64_t kind);

typedef struct pf_written pf_written;

pf_written *pf_written_create(const pf_memory *memory); /* NULL: no memory */
void pf_written_destroy(pf_written *written);           /* NULL is ignored */
bool pf_written_has(const pf_written *written, pf_print print);
/* The offset of the record with a print; 0: it is new, and the caller sets it. Valid until the next
 * call. NULL: no memory. */
uint64_t *pf_written_find(pf_written *written, pf_print print);
