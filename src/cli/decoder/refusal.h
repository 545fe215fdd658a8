/* Pictures that ended a decoder: they are not tried again.
 *
 * INVARIANT: a file that was changed since is another file. At most CS_REFUSALS_MOST are remembered,
 * the last ones. Any thread.
 */
#ifndef CS_CLI_DECODER_REFUSAL_H
#define CS_CLI_DECODER_REFUSAL_H

#include <sys/stat.h>

#include "pictures/module.h"

enum { CS_REFUSALS_MOST = 64 };

/* What a file is as long as it is not changed. */
typedef struct cs_refusal_key {
  uint64_t device, number;
  int64_t size, time; /* nanoseconds */
} cs_refusal_key;

cs_refusal_key cs_refusal_key_of(const struct stat *file);
bool cs_refusal_is_same(const cs_refusal_key *a, const cs_refusal_key *b);

void cs_refusal_add(const cs_refusal_key *key, const cs_picture_failure *failure);
/* false: nothing is known against it. */
bool cs_refusal_find(const cs_refusal_key *key, cs_picture_failure *failure);

#endif
