/* The store of decoded pictures: blocks of texels in one budget, shared by all threads.
 *
 *   entry   one for each picture: its header, its open reader, how its codes become light
 *   block   64 x 64 texels of one level of an entry, in the store's cache (base/cache.h)
 *
 * Reading goes through the picture module (model/pictures/module.h), a shared object that is loaded
 * on first use: a film without pictures never loads it, nor one of which all are in memory.
 *
 * Locks: `lock` guards entries and tables, and is never held while pixels are read; an entry's
 * `reading` guards its reader and is locked before `lock`. The contents of a block are a function
 * of the picture alone, so frames depend neither on the budget nor on the number of threads.
 */
#pragma once

#include "base/cache.h"
#include "model/colour/srgb8.h"
#include "model/pictures/mip_levels.h"
#include "model/pictures/picture.h"

/* Texels of a block's side. */
#define CS_PICTURE_BLOCK 64
/* Codes in a row of a block: one for each texel, and one for the texel right of the block. */
#define CS_PICTURE_CODES_ROW (CS_PICTURE_BLOCK + 1)
/* The sizes of a block's codes, and of its texels and codes. */
#define CS_PICTURE_CODES_BYTES ((size_t)CS_PICTURE_BLOCK * 4 * CS_PICTURE_CODES_ROW)
#define CS_PICTURE_TEXELS_BYTES ((size_t)CS_PICTURE_BLOCK * 16 * CS_PICTURE_BLOCK)
#define CS_PICTURE_BLOCK_BYTES (CS_PICTURE_TEXELS_BYTES + CS_PICTURE_CODES_BYTES)

/* The common properties of all texels of a block that lie in the picture. */
typedef enum cs_picture_opacity {
  CS_PICTURE_MIXED,
  CS_PICTURE_OPAQUE, /* alpha is 1 */
  CS_PICTURE_CLEAR   /* colour and alpha are 0 */
} cs_picture_opacity;

typedef struct cs_picture_entry cs_picture_entry;
typedef struct cs_picture_store cs_picture_store;

/* One block of a picture at a mip level (a texel is the mean of 2^level x 2^level pixels, in linear
 * light). Constant once it is in the store. */
typedef struct cs_picture_block {
  cs_cache_entry cached; /* key: the picture's hash, level, column and row */
  cs_picture_store *store;
  int level;
  int32_t column, row;
  cs_picture_opacity opacity;
  /* Whether the codes are exact: cs_srgb8_colour makes the texels from them to the bit, including
   * the column right of the block unless the picture ends there. */
  bool is_coded;
  /* Premultiplied linear RGBA, row-major; clear beyond the picture. Stored apart from the block, so
   * that blocks lie close together: each row of a frame searches for many blocks. */
  float *texels;
  /* Of level 0: its texels as 8-bit pixels, sRGB and straight, as cs_srgb8_pixel makes them; else
   * NULL. A row of a frame is read from the codes of many blocks in turn, which is twice as quick
   * where they lie close together: so they are apart from the texels. */
  unsigned char (*codes)[4 * CS_PICTURE_CODES_ROW];
} cs_picture_block;

struct cs_picture_entry {
  cs_picture_entry *next;
  cs_picture_store *store;
  cs_hash hash;
  /* calls that use the entry now; if there are none, the entry may be removed, unless it is of a
   * file that is no tile */
  atomic_size_t users;
  cs_picture *picture; /* a reference; NULL: the entry is of a surface, a part, or tiles */
  cs_picture_header header;
  cs_mip_levels_decoder decoder;
  int level_count;
  /* The first level of which all blocks fit into `share`. This level and the levels below it are
   * made from the rows of the file; each higher level is made from the level below. */
  int base;
  size_t share;              /* blocks that one pass over the file may make: half the budget */
  int tiled_levels;          /* that have tiles; those above are made from the level below */
  pthread_mutex_t reading;   /* of a picture in tiles recursive: levels are made of its others */
  cs_picture_reader *reader; /* NULL while it is closed, and for a part */
  int32_t next_strip;        /* in a sequential format the first row of blocks that is not read */
  const celspan_surface *surface; /* while `reading` is locked: of the picture that is loaded */
  const cs_picture *part;         /* likewise: what is loaded, if it is a part or in tiles */
};

struct cs_picture_store {
  cs_service service;
  cs_memory *memory;
  const cs_picture_module *module; /* NULL until it is needed */
  cs_cache blocks; /* its budget is at least a row of blocks of the widest picture */
  pthread_mutex_t lock;
  cs_picture_entry *entries[256];      /* by hash */
  size_t surface_count, surface_limit; /* entries that may be removed; there may be more if they
                                          are in use */
  size_t reader_count;                 /* readers open now */
  float *tables[8][17];                /* light by code, for each transfer and number of bits */
  cs_srgb8_curve curve;                /* the light of all codes */
};

/* The facts of the header, which is read once in a context. Errors: INPUT, LIMIT, NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_store_info(celspan_context *context, const cs_picture *picture,
                                             celspan_picture_info *out);
/* The pixels for an inch that the file says; 0: it does not. Errors: as cs_store_info. */
CELSPAN_CHECKED celspan_status cs_store_dpi(celspan_context *context, const cs_picture *picture,
                                            double *out);
/* The picture module. failure: the status if there is no module, INPUT or OUTPUT. */
CELSPAN_CHECKED celspan_status cs_store_module(celspan_context *context, celspan_status failure,
                                               const cs_picture_module **out);
/* The request to the module. The texts belong to the picture. */
cs_picture_request cs_store_request(const cs_picture *picture);
/* Without a `colour` of the picture, its file must say in numbers that can be used what its colours
 * mean. header: of its file. Errors: INPUT. */
CELSPAN_CHECKED celspan_status cs_store_check_colours(celspan_context *context,
                                                      const cs_picture *picture,
                                                      const cs_picture_header *header);
/* Removes a pin. */
void cs_store_release(cs_picture_block *block);

/* ---------------------------------------------------------------- for model/pictures/load.c */

/* The entry of a picture, in use until cs_store_leave. Errors: as cs_store_info, BAD_ARGUMENT. */
CELSPAN_CHECKED celspan_status cs_store_entry(celspan_context *context, const cs_picture *picture,
                                              cs_picture_entry **out);
void cs_store_leave(cs_picture_entry *entry);
/* Pins a block and returns it; NULL when it is not in the store. */
cs_picture_block *cs_store_pin(const cs_picture_entry *entry, int level, int32_t column,
                               int32_t row);
/* A new block, without texels and codes, not yet in the store, but counted. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_store_create_block(celspan_context *context,
                                                     cs_picture_entry *entry, int level,
                                                     int32_t column, int32_t row,
                                                     cs_picture_block **out);
/* Give a new block room for its texels, which are clear, and for its codes. The codes of blocks
 * that get their room one after the other lie close together. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_store_add_texels(celspan_context *context,
                                                   cs_picture_block *block);
CELSPAN_CHECKED celspan_status cs_store_add_codes(celspan_context *context,
                                                  cs_picture_block *block);
/* Puts the block into the store; if the store has it already, returns the one in the store. */
cs_picture_block *cs_store_insert(cs_picture_block *block, bool is_pinned);
/* Frees a block that was never inserted. NULL is ignored. */
void cs_store_discard(cs_picture_block *block);
/* cs_store_open_reader opens the entry's reader; the other function closes it until it is needed
 * again. The caller has locked `reading`. */
CELSPAN_CHECKED celspan_status cs_store_open_reader(celspan_context *context,
                                                    cs_picture_entry *entry);
void cs_store_close_reader(cs_picture_entry *entry);
