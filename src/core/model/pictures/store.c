#include "model/pictures/store.h"

#include <unistd.h>

#include "base/description.h"
#include "base/module.h"
#include "model/colour/primaries.h"
#include "model/colour/transfer.h"
#include "model/pictures/surface.h"
#include "model/pictures/tile_file.h"

/* Files kept open at a time: a film may have a picture for every frame. */
#define OPEN_READERS 32
/* If there are more entries of surfaces and tiles than this, unused ones are removed. */
#define SURFACES_LEAST 256

/* ---------------------------------------------------------------- the store itself */

static void destroy_entry(cs_picture_store *store, cs_picture_entry *entry) {
  if (entry->reader)
    store->module->close(entry->reader);
  pthread_mutex_destroy(&entry->reading);
  cs_picture_unref(entry->picture);
  cs_mem_free(store->memory, entry, sizeof *entry);
}

static void destroy_store(cs_service *service) {
  cs_picture_store *store = (cs_picture_store *)service;
  cs_cache_finish(&store->blocks);
  for (size_t i = 0; i < sizeof store->entries / sizeof *store->entries; i++)
    for (cs_picture_entry *entry = store->entries[i], *next; entry; entry = next) {
      next = entry->next;
      destroy_entry(store, entry);
    }
  for (int transfer = 0; transfer < 8; transfer++)
    for (int bits = 0; bits <= 16; bits++)
      cs_mem_free(store->memory, store->tables[transfer][bits], sizeof(float) << bits);
  pthread_mutex_destroy(&store->lock);
  cs_mem_free(store->memory, store, sizeof *store);
}

static void clear_block(cs_cache_entry *entry, cs_memory *memory) {
  const cs_picture_block *block = (const cs_picture_block *)entry;
  cs_mem_free(memory, block->texels, CS_PICTURE_TEXELS_BYTES);
  cs_mem_free(memory, block->codes, CS_PICTURE_CODES_BYTES);
}

static celspan_status create_store(celspan_context *context, cs_service **out) {
  cs_picture_store *store;
  CS_TRY(CS_MAKE(context, store, 1));
  store->memory = context->memory;
  store->blocks = (cs_cache){.memory = context->memory,
                             .entry_size = sizeof(cs_picture_block),
                             .clear = clear_block,
                             .budget = context->root->picture_bytes};
  cs_cache_init(&store->blocks);
  store->surface_limit = SURFACES_LEAST;
  cs_srgb8_make_curve(&store->curve);
  pthread_mutex_init(&store->lock, NULL);
  *out = &store->service;
  return CELSPAN_OK;
}

static void trim_store(cs_service *service) {
  cs_cache_trim(&((cs_picture_store *)service)->blocks);
}

static const cs_service_kind store_kind = {create_store, destroy_store, trim_store};

static celspan_status get_store(celspan_context *context, cs_picture_store **out) {
  cs_service *service;
  CS_TRY(cs_context_service(context, &store_kind, &service));
  *out = (cs_picture_store *)service;
  return CELSPAN_OK;
}

static celspan_status load_module(celspan_context *context, cs_picture_store *store,
                                  celspan_status failure) {
  if (!store->module)
    store->module = context->root->picture_module;
  if (store->module)
    return CELSPAN_OK;
  const void *table;
  CS_TRY(cs_module_load(context, &cs_modules_picture, CS_PICTURE_MODULE_VERSION, failure, &table));
  store->module = table;
  return CELSPAN_OK;
}

celspan_status cs_store_module(celspan_context *context, celspan_status failure,
                               const cs_picture_module **out) {
  cs_picture_store *store;
  CS_TRY(get_store(context, &store));
  pthread_mutex_lock(&store->lock);
  celspan_status status = load_module(context, store, failure);
  pthread_mutex_unlock(&store->lock);
  if (status == CELSPAN_OK)
    *out = store->module;
  return status;
}

/* ---------------------------------------------------------------- blocks */

/* The bytes of a block; a block of level 0 has codes, too. */
#define PLAIN_BYTES (sizeof(cs_picture_block) + CS_PICTURE_TEXELS_BYTES)
#define BLOCK_BYTES (PLAIN_BYTES + CS_PICTURE_CODES_BYTES)

/* The key contains the hash, not the entry: blocks of a surface live longer than an entry that was
 * removed. */
static cs_cache_key key_of(const cs_picture_entry *entry, int level, int32_t column, int32_t row) {
  return (cs_cache_key){entry->hash.a, entry->hash.b,
                        (uint64_t)level << 56 | (uint64_t)column << 28 | (uint64_t)row};
}

cs_picture_block *cs_store_pin(const cs_picture_entry *entry, int level, int32_t column,
                               int32_t row) {
  return (cs_picture_block *)cs_cache_pin(&entry->store->blocks, key_of(entry, level, column, row));
}

void cs_store_release(cs_picture_block *block) {
  cs_cache_unpin(&block->store->blocks, &block->cached);
}

celspan_status cs_store_create_block(celspan_context *context, cs_picture_entry *entry, int level,
                                     int32_t column, int32_t row, cs_picture_block **out) {
  cs_cache_entry *cached;
  CS_TRY(cs_cache_create(&entry->store->blocks, context, key_of(entry, level, column, row),
                         level == 0 ? BLOCK_BYTES : PLAIN_BYTES, &cached));
  cs_picture_block *block = (cs_picture_block *)cached;
  block->store = entry->store;
  block->level = level;
  block->column = column;
  block->row = row;
  *out = block;
  return CELSPAN_OK;
}

celspan_status cs_store_add_texels(celspan_context *context, cs_picture_block *block) {
  block->texels = cs_mem_array(block->store->memory, 1, CS_PICTURE_TEXELS_BYTES);
  return block->texels ? CELSPAN_OK : cs_fail_memory(context);
}

celspan_status cs_store_add_codes(celspan_context *context, cs_picture_block *block) {
  block->codes = cs_mem_array(block->store->memory, 1, CS_PICTURE_CODES_BYTES);
  return block->codes ? CELSPAN_OK : cs_fail_memory(context);
}

cs_picture_block *cs_store_insert(cs_picture_block *block, bool is_pinned) {
  return (cs_picture_block *)cs_cache_insert(&block->store->blocks, &block->cached, is_pinned);
}

void cs_store_discard(cs_picture_block *block) {
  if (block)
    cs_cache_discard(&block->store->blocks, &block->cached);
}

/* ---------------------------------------------------------------- entries */

cs_picture_request cs_store_request(const cs_picture *picture) {
  celspan_transfer transfer;
  bool is_space = picture->colour && !cs_transfer_parse(picture->colour, &transfer);
  return (cs_picture_request){.file = picture->file,
                              .layer = picture->layer,
                              .subimage = picture->subimage,
                              .space = is_space ? picture->colour : NULL};
}

/* Finds an entry and marks it as in use; NULL: there is none. The caller has locked `lock`. */
static cs_picture_entry *find_entry(const cs_picture_store *store, cs_hash hash) {
  cs_picture_entry *entry = store->entries[hash.a & 255];
  while (entry && !(entry->hash.a == hash.a && entry->hash.b == hash.b))
    entry = entry->next;
  if (entry)
    atomic_fetch_add_explicit(&entry->users, 1, memory_order_relaxed);
  return entry;
}

void cs_store_leave(cs_picture_entry *entry) {
  atomic_fetch_sub_explicit(&entry->users, 1, memory_order_release);
}

static size_t blocks_across(int32_t size, int level) {
  return ((size_t)cs_mip_levels_size(size, level) + CS_PICTURE_BLOCK - 1) / CS_PICTURE_BLOCK;
}

/* A row of a frame reads along a row of blocks. If the budget were less than that, every row of the
 * frame would read the file again. A quarter more leaves room for the next row of blocks. A row of
 * smooth blocks is made from three other rows. In tiles, blocks are made one by one. The caller has
 * locked `lock`. */
static void plan_entry(cs_picture_store *store, bool is_smooth, cs_picture_entry *entry) {
  const celspan_picture_info *info = &entry->header.info;
  entry->level_count = cs_mip_levels_count(info->width, info->height);
  if (entry->tiled_levels > 0)
    return;
  size_t rows = is_smooth ? 4 : 1;
  size_t least = blocks_across(info->width, 0) * BLOCK_BYTES * (4 * rows + 1) / 4;
  entry->share = cs_cache_raise_budget(&store->blocks, least) / 2 / BLOCK_BYTES;
  while (entry->base < entry->level_count - 1 &&
         blocks_across(info->width, entry->base) * blocks_across(info->height, entry->base) >
             entry->share)
    entry->base++;
}

/* The table of light by code for a transfer and a number of bits, made on first use. The caller has
 * locked `lock`. */
static const float *find_table(cs_picture_store *store, celspan_transfer transfer, int bits) {
  float **table = &store->tables[transfer][bits];
  if (*table)
    return *table;
  int32_t codes = (int32_t)1 << bits;
  *table = cs_mem_array(store->memory, (size_t)codes, sizeof(float));
  for (int32_t code = 0; *table && code < codes; code++)
    (*table)[code] = cs_transfer_decode(transfer, (float)((double)code / (codes - 1)));
  return *table;
}

/* A file of celspan's own primaries is not converted, to the last bit. */
static bool has_other_primaries(const cs_picture_header *header) {
  const char *known = header->has_primaries ? cs_primaries_name(header->primaries) : NULL;
  return header->has_primaries && (!known || strcmp(known, cs_primaries_known[0].name) != 0);
}

static bool set_decoder(cs_picture_store *store, const char *colour, cs_picture_entry *entry) {
  const cs_picture_header *header = &entry->header;
  const char *name = colour ? colour : header->info.colour;
  cs_mip_levels_decoder *decoder = &entry->decoder;
  decoder->transfer = CELSPAN_TRANSFER_LINEAR;
  decoder->alpha = header->alpha;
  decoder->is_linear = header->is_linear;
  decoder->has_matrix = !colour && has_other_primaries(header) &&
                        cs_primaries_to_bt709(header->primaries, decoder->matrix);
  if (header->is_linear)
    return true;
  if (!cs_transfer_parse(name, &decoder->transfer) || header->bits < 1 || header->bits > 16)
    return true;
  decoder->codes = ((int32_t)1 << header->bits) - 1;
  decoder->table = find_table(store, decoder->transfer, header->bits);
  return decoder->table;
}

celspan_status cs_store_check_colours(celspan_context *context, const cs_picture *picture,
                                      const cs_picture_header *header) {
  double unused[9];
  if (picture->colour || header->is_linear)
    return CELSPAN_OK;
  if (strcmp(header->info.colour, CS_PICTURE_OTHER) == 0)
    return cs_fail(context, CELSPAN_INPUT,
                   "%s: its colours are in \"%s\", which celspan does not have: name the space in "
                   "the script, as colour, or with --ocio or OCIO a configuration that has it",
                   picture->file, header->space);
  if (has_other_primaries(header) && !cs_primaries_to_bt709(header->primaries, unused))
    return cs_fail(context, CELSPAN_INPUT,
                   "%s: its chromaticities are those of no light: say in the script, as colour, "
                   "what its colours are, such as \"linear\"",
                   picture->file);
  return CELSPAN_OK;
}

static celspan_status open_file(celspan_context *context, const cs_picture *picture,
                                cs_picture_entry *entry) {
  cs_picture_request request = cs_store_request(picture);
  cs_picture_failure failure;
  const cs_picture_module *module;
  CS_TRY(cs_store_module(context, CELSPAN_INPUT, &module));
  celspan_status status = module->open(&request, &entry->reader, &entry->header, &failure);
  bool was_tried = status != CELSPAN_OK && picture->tried && access(picture->file, F_OK) != 0;
  if (status != CELSPAN_OK)
    return cs_fail(context, status, "%s%s%s", failure.text,
                   was_tried ? "; also looked for at " : "", was_tried ? picture->tried : "");
  status = cs_store_check_colours(context, picture, &entry->header);
  if (status != CELSPAN_OK) {
    module->close(entry->reader);
    return status;
  }
  entry->picture = cs_picture_ref((cs_picture *)(uintptr_t)picture);
  entry->header.is_whole = entry->header.is_whole || picture->is_tile;
  return CELSPAN_OK;
}

/* The header of a part: the header of the whole picture, with another size. Its rows can be read in
 * any order. */
static celspan_status open_part(celspan_context *context, const cs_picture *part,
                                cs_picture_header *header) {
  cs_picture_entry *whole;
  CS_TRY(cs_store_entry(context, part->whole, &whole));
  *header = whole->header;
  cs_store_leave(whole);
  celspan_picture_info *info = &header->info;
  header->is_turned = header->is_whole = header->is_sequential = false;
  if (part->width == 0)
    return CELSPAN_OK;
  if (part->x + part->width > info->width || part->y + part->height > info->height)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: source {%d, %d, %d, %d} is not inside the picture, which is %d x %d pixels",
                   cs_picture_name(part), part->x, part->y, part->width, part->height, info->width,
                   info->height);
  info->width = part->width;
  info->height = part->height;
  return CELSPAN_OK;
}

static celspan_status open_entry(celspan_context *context, cs_picture_store *store,
                                 const cs_picture *picture, cs_picture_entry **out) {
  cs_picture_entry *entry = cs_mem_array(store->memory, 1, sizeof *entry);
  if (!entry)
    return cs_fail_memory(context);
  celspan_status status = CELSPAN_OK;
  if (picture->whole)
    status = open_part(context, picture, &entry->header);
  else if (picture->tiles.size > 0)
    status = cs_tile_file_describe(context, picture, &entry->header, &entry->tiled_levels);
  else if (picture->surface)
    cs_surface_describe(picture->surface, &entry->header);
  else
    status = open_file(context, picture, entry);
  if (status != CELSPAN_OK) {
    cs_mem_free(store->memory, entry, sizeof *entry);
    return status;
  }
  pthread_mutexattr_t kind;
  pthread_mutexattr_init(&kind);
  if (entry->tiled_levels > 0)
    pthread_mutexattr_settype(&kind, PTHREAD_MUTEX_RECURSIVE);
  pthread_mutex_init(&entry->reading, &kind);
  pthread_mutexattr_destroy(&kind);
  atomic_init(&entry->users, 1);
  entry->hash = picture->hash;
  entry->store = store;
  *out = entry;
  return CELSPAN_OK;
}

static void close_unused(cs_picture_store *store, cs_picture_entry *entry) {
  if (pthread_mutex_trylock(&entry->reading) != 0)
    return;
  if (entry->reader) {
    store->module->close(entry->reader);
    entry->reader = NULL;
    store->reader_count--;
  }
  pthread_mutex_unlock(&entry->reading);
}

/* Closes readers that nobody uses until one more may be opened. The caller has locked `lock`. */
static void close_readers(cs_picture_store *store) {
  for (size_t i = 0; i < sizeof store->entries / sizeof *store->entries; i++)
    for (cs_picture_entry *entry = store->entries[i]; entry; entry = entry->next)
      if (store->reader_count >= OPEN_READERS)
        close_unused(store, entry);
}

static bool is_kept(const cs_picture_entry *entry) {
  return entry->picture && !entry->picture->is_tile;
}

/* Removes the entries of surfaces and tiles that nobody uses: a host may make a surface for every
 * frame, and a picture may have millions of tiles. The caller has locked `lock`. */
static void drop_unused(cs_picture_store *store) {
  for (size_t i = 0; i < sizeof store->entries / sizeof *store->entries; i++)
    for (cs_picture_entry **link = &store->entries[i], *entry; (entry = *link);) {
      if (is_kept(entry) || atomic_load_explicit(&entry->users, memory_order_acquire)) {
        link = &entry->next;
        continue;
      }
      *link = entry->next;
      store->reader_count -= entry->reader != NULL;
      destroy_entry(store, entry);
      store->surface_count--;
    }
  store->surface_limit = 2 * store->surface_count + SURFACES_LEAST;
}

/* The caller has locked `lock`. */
static void count_entry(cs_picture_store *store, const cs_picture_entry *entry) {
  if (entry->picture) {
    close_readers(store);
    store->reader_count++;
  }
  if (is_kept(entry))
    return;
  if (store->surface_count >= store->surface_limit)
    drop_unused(store);
  store->surface_count++;
}

/* The caller has locked `lock`. */
static bool keep_entry(cs_picture_store *store, const cs_picture *picture,
                       cs_picture_entry *entry) {
  if (!set_decoder(store, picture->colour, entry))
    return false;
  plan_entry(store, picture->is_smooth, entry);
  count_entry(store, entry);
  entry->next = store->entries[entry->hash.a & 255];
  store->entries[entry->hash.a & 255] = entry;
  return true;
}

static celspan_status add_entry(celspan_context *context, cs_picture_store *store,
                                const cs_picture *picture, cs_picture_entry **out) {
  cs_picture_entry *entry = NULL;
  CS_TRY(open_entry(context, store, picture, &entry));
  pthread_mutex_lock(&store->lock);
  cs_picture_entry *known = find_entry(store, picture->hash);
  bool is_kept = !known && keep_entry(store, picture, entry);
  pthread_mutex_unlock(&store->lock);
  if (!is_kept)
    destroy_entry(store, entry);
  if (!is_kept && !known)
    return cs_fail_memory(context);
  *out = known ? known : entry;
  return CELSPAN_OK;
}

celspan_status cs_store_entry(celspan_context *context, const cs_picture *picture,
                              cs_picture_entry **out) {
  cs_picture_store *store;
  CS_TRY(get_store(context, &store));
  pthread_mutex_lock(&store->lock);
  cs_picture_entry *entry = find_entry(store, picture->hash);
  pthread_mutex_unlock(&store->lock);
  if (!entry)
    return add_entry(context, store, picture, out);
  *out = entry;
  return CELSPAN_OK;
}

celspan_status cs_store_info(celspan_context *context, const cs_picture *picture,
                             celspan_picture_info *out) {
  cs_picture_entry *entry;
  CS_TRY(cs_store_entry(context, picture, &entry));
  *out = entry->header.info;
  cs_store_leave(entry);
  return CELSPAN_OK;
}

celspan_status cs_store_dpi(celspan_context *context, const cs_picture *picture, double *out) {
  cs_picture_entry *entry;
  CS_TRY(cs_store_entry(context, picture, &entry));
  *out = entry->header.dpi;
  cs_store_leave(entry);
  return CELSPAN_OK;
}

celspan_status celspan_picture_inspect(celspan_context *context, const celspan_picture_desc *desc,
                                       celspan_picture_info *out) {
  cs_picture *picture;
  celspan_picture_info info;
  CS_TRY(cs_picture_create(context, desc, &picture));
  celspan_status status = cs_store_info(context, picture, &info);
  cs_picture_unref(picture);
  return status == CELSPAN_OK ? CS_RESULT(context, "picture", celspan_picture_info, &info, out)
                              : status;
}

/* ---------------------------------------------------------------- readers */

static bool is_same_file(const cs_picture_header *a, const cs_picture_header *b) {
  return a->file_size == b->file_size && a->file_time == b->file_time &&
         a->file_number == b->file_number;
}

celspan_status cs_store_open_reader(celspan_context *context, cs_picture_entry *entry) {
  cs_picture_store *store = entry->store;
  if (entry->reader)
    return CELSPAN_OK;
  cs_picture_request request = cs_store_request(entry->picture);
  cs_picture_failure failure;
  cs_picture_header header;
  cs_picture_reader *reader;
  celspan_status status = store->module->open(&request, &reader, &header, &failure);
  if (status != CELSPAN_OK)
    return cs_fail(context, status, "%s", failure.text);
  if (!is_same_file(&header, &entry->header)) {
    store->module->close(reader);
    return cs_fail(context, CELSPAN_INPUT, "%s: changed while it was in use", entry->picture->file);
  }
  entry->reader = reader;
  entry->next_strip = 0;
  pthread_mutex_lock(&store->lock);
  close_readers(store);
  store->reader_count++;
  pthread_mutex_unlock(&store->lock);
  return CELSPAN_OK;
}

void cs_store_close_reader(cs_picture_entry *entry) {
  cs_picture_store *store = entry->store;
  if (!entry->reader)
    return;
  store->module->close(entry->reader);
  entry->reader = NULL;
  pthread_mutex_lock(&store->lock);
  store->reader_count--;
  pthread_mutex_unlock(&store->lock);
}
