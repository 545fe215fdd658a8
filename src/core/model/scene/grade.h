/* A grade as a value of the scene: counted, checked, with a hash of its steps. Only the group of a
 * key has a grade with a key (key.c). */
#pragma once

#include "base/hash.h"
#include "model/colour/grade.h"

struct celspan_grade {
  atomic_size_t references;
  cs_memory *memory;
  cs_hash hash; /* the hash of a table of colours its contents count, not its name */
  cs_grade steps;
  /* The description, for the oracle. It points to the curves of the steps, and names no files. */
  celspan_grade_desc desc;
  celspan_key_desc key; /* the key of a key, likewise; it names no colour */
  float screen[3];      /* the colour of a key, as light */
};

/* The values of a grade for the compiler and the oracle; NULL: there is none. */
static inline const cs_grade *cs_grade_steps(const celspan_grade *grade) {
  return grade ? &grade->steps : NULL;
}

/* Whether it is the grade of a key, which changes where the graded is present. */
static inline bool cs_grade_keys(const celspan_grade *grade) {
  return grade && grade->steps.keying.is_given;
}

/* grade: NULL adds nothing to the hash, so that values without a grade have the same hashes as
 * before. */
static inline void cs_grade_hash(cs_hash *hash, const celspan_grade *grade) {
  if (grade)
    cs_hash_hash(hash, grade->hash);
}
