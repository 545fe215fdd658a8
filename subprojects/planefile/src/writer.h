/* The one writer, which writer.c leads from frame to frame, and whose records records.c writes. */
#pragma once

#include "band.h"
#include "written.h"

typedef struct pf_entry {
  int32_t top;
  uint64_t offset;
} pf_entry;

/* A band of the key frame. */
typedef struct pf_key_band {
  pf_entry at;
  pf_band band; /* as it is read */
  pf_base base;
} pf_key_band;

/* A band that may be written. */
typedef struct pf_draft {
  unsigned char kind;
  pf_encoder code;
} pf_draft;

struct planefile_writer {
  planefile_writer_desc desc;
  pf_memory memory;
  pf_codes codes;    /* where cells are codes */
  uint64_t offset;   /* in the file */
  pf_written *known; /* the records of a film; NULL: a single plane */
  uint64_t *frames;  /* the offsets of their indices */
  size_t frame_count, frame_capacity;
  uint64_t index;             /* the offset of the latest index */
  pf_written *shown_pictures; /* their numbers in the file, plus 1, by their keys; NULL: none */
  uint64_t *pictures;         /* their offsets */
  size_t picture_count, picture_capacity;

  /* the key frame of a film; no bands: there is none yet */
  pf_key_band *key;
  size_t key_count, key_capacity;
  uint64_t key_index;
  uint32_t key_flags;
  size_t first, excess; /* bytes: of the first frame made from it, and of the others beyond that */

  /* of the current frame */
  const planefile_band *plane;
  uint32_t flags;
  bool has_base;             /* it is made from the key */
  pf_draft *drafts;          /* the drafts of its bands */
  planefile_border *borders; /* by their tops */
  planefile_border *shown;   /* those of the current band */
  pf_entry *entries;
  size_t shown_count, shown_capacity, entry_count, entry_capacity;
};

static inline bool pf_is_film(const planefile_writer *w) { return w->desc.frames_second > 0; }

planefile_status pf_writer_put_header(planefile_writer *w);
/* Whether a band is in the film already. */
bool pf_writer_has(const planefile_writer *w, unsigned char kind, const pf_encoder *code);
/* A record that a film has once. *offset: where it is. */
planefile_status pf_writer_put_once(planefile_writer *w, unsigned char kind,
                                    const unsigned char *payload, size_t size, uint64_t *offset);
/* Writes the pictures that are seen. axes: room for those of the plane, which get their numbers in
 * the file. */
planefile_status pf_writer_put_pictures(planefile_writer *w, const planefile_band *plane,
                                        planefile_axis *axes);
/* Of the entries of the current frame. */
planefile_status pf_writer_put_index(planefile_writer *w);
planefile_status pf_writer_put_frames(planefile_writer *w);
/* last: the offset of the last record. */
planefile_status pf_writer_put_trailer(planefile_writer *w, uint64_t last);
