/* The store of decoded pictures: blocks of texels in one budget, shared by all threads.
 *
 *   entry   one a picture: its header, its open reader, how its codes become light
 *   block   64 x 64 texels of one level of an entry; pinned, or in the list of what may be dropped
 *
 * Locks: `lock` guards entries, blocks and the list, and is never held while a file is read; an
 * entry's `reading` guards its reader and is taken before `lock`. What a block holds is a function
 * of the file alone, so neither budget nor threads show in the pictures.
 */
#ifndef CS_PICTURES_STORE_H
#define CS_PICTURES_STORE_H

#include <pthread.h>

#include "pictures/levels.h"
#include "pictures/picture.h"

struct cs_picture {
  atomic_size_t references;
  cs_memory *memory;
  cs_hash hash;
  char *file, *colour, *layer; /* colour, layer: may be NULL */
  int subimage;
};

typedef struct cs_picture_entry cs_picture_entry;
typedef struct cs_picture_store cs_picture_store;

struct cs_picture_block {
  cs_picture_entry *entry;
  int level;
  int32_t column, row;
  uint32_t pins;
  cs_picture_block *next;          /* in its bucket */
  cs_picture_block *older, *newer; /* while it has no pins */
  cs_picture_opacity look;
  bool is_coded;
  float texels[4 * CS_PICTURE_BLOCK * CS_PICTURE_BLOCK];
  unsigned char codes[CS_PICTURE_BLOCK][4 * CS_PICTURE_CODES_ROW]; /* of level 0 */
};

struct cs_picture_entry {
  cs_picture_entry *next;
  uint32_t number; /* in order of making */
  cs_hash hash;
  cs_picture *picture; /* kept */
  cs_picture_header header;
  cs_levels_decoder decoder;
  const cs_srgb8_curve *curve; /* the store's */
  int level_count;
  /* The first level of which all blocks fit `share`. Levels below it are read from the file in
   * rows, those above are made from it. */
  int base;
  size_t share; /* blocks that one pass over the file may make: half the budget */
  pthread_mutex_t reading;
  cs_picture_reader *reader; /* NULL while closed */
  int32_t next_strip;        /* of a sequential format: the first row of blocks not read yet */
};

struct cs_picture_store {
  cs_service service;
  cs_memory *memory;
  pthread_mutex_t lock;
  const cs_picture_module *module; /* NULL until it is needed */
  size_t budget, bytes; /* the budget holds a row of blocks of the widest picture at least */
  cs_picture_entry *entries[256]; /* by hash */
  uint32_t entry_count;
  size_t reader_count; /* readers open now */
  cs_picture_block **buckets;
  size_t bucket_count, block_count;
  cs_picture_block *oldest, *newest;
  float *tables[8][17]; /* light by code: of a transfer, for codes of so many bits */
  cs_srgb8_curve curve;
};

/* The context's store, made on first use. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_store_get(celspan_context *context, cs_picture_store **out);
/* The picture module. failure: INPUT or OUTPUT, when there is none. */
CELSPAN_CHECKED celspan_status cs_store_module(celspan_context *context, celspan_status failure,
                                               const cs_picture_module **out);
/* The entry of a picture, its header read. Errors: INPUT, LIMIT, NO_MEMORY, BAD_ARGUMENT. */
CELSPAN_CHECKED celspan_status cs_store_entry(celspan_context *context, cs_picture_store *store,
                                              const cs_picture *picture, cs_picture_entry **out);
/* The block with a pin more, or NULL when it is not held. */
cs_picture_block *cs_store_pin(cs_picture_store *store, const cs_picture_entry *entry, int level,
                               int32_t column, int32_t row);
/* A new block, zeroed, not yet in the store, but counted. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_store_make(celspan_context *context, cs_picture_store *store,
                                             cs_picture_entry *entry, int level, int32_t column,
                                             int32_t row, cs_picture_block **out);
/* Gives the block to the store with `pins` 0 or 1; one that is held already wins, and is what
 * comes back. */
cs_picture_block *cs_store_insert(cs_picture_store *store, cs_picture_block *block, uint32_t pins);
/* Frees a block that was never inserted. NULL is ignored. */
void cs_store_discard(cs_picture_store *store, cs_picture_block *block);
void cs_store_unpin(cs_picture_store *store, cs_picture_block *block);
/* The entry's reader, open. The caller holds `reading`. */
CELSPAN_CHECKED celspan_status cs_store_reader(celspan_context *context, cs_picture_store *store,
                                               cs_picture_entry *entry);
/* Closes it until it is wanted again. The caller holds `reading`. */
void cs_store_close(cs_picture_store *store, cs_picture_entry *entry);

/* picture_load.c: a block that is not held, with a pin. The caller holds `reading`.
 * Errors: INPUT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_load_block(celspan_context *context, cs_picture_store *store,
                                             cs_picture_entry *entry, int level, int32_t column,
                                             int32_t row, cs_picture_block **out);

#endif
