#include "pictures/store.h"

#include <string.h>

#include "base/module.h"
#include "base/number.h"
#include "colour/transfer.h"

/* Files kept open at a time: a film may have a picture for every frame. */
#define OPEN_READERS 32

static const cs_module_desc picture_module = {
    .file = "celspan-picture.so",
    .override = "CELSPAN_PICTURE_MODULE",
    .symbol = "celspan_picture_module",
    .purpose = "reading and writing pictures",
    .advice = "install OpenImageIO and the celspan package with pictures",
};

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
  for (size_t i = 0; i < store->bucket_count; i++)
    for (cs_picture_block *block = store->buckets[i], *next; block; block = next) {
      next = block->next;
      cs_mem_free(store->memory, block, sizeof *block);
    }
  for (size_t i = 0; i < sizeof store->entries / sizeof *store->entries; i++)
    for (cs_picture_entry *entry = store->entries[i], *next; entry; entry = next) {
      next = entry->next;
      destroy_entry(store, entry);
    }
  for (int transfer = 0; transfer < 8; transfer++)
    for (int bits = 0; bits <= 16; bits++)
      cs_mem_free(store->memory, store->tables[transfer][bits], sizeof(float) << bits);
  cs_mem_free(store->memory, store->buckets, store->bucket_count * sizeof *store->buckets);
  pthread_mutex_destroy(&store->lock);
  cs_mem_free(store->memory, store, sizeof *store);
}

static void trim_store(cs_service *service);

celspan_status cs_store_get(celspan_context *context, cs_picture_store **out) {
  celspan_context *root = context->root;
  cs_service *held = __atomic_load_n(&root->pictures, __ATOMIC_ACQUIRE);
  if (!held) {
    cs_picture_store *store = cs_mem_array(context->memory, 1, sizeof *store);
    if (!store)
      return cs_fail_memory(context);
    store->service = (cs_service){destroy_store, trim_store};
    store->memory = context->memory;
    store->budget = root->picture_bytes;
    cs_srgb8_make_curve(&store->curve);
    pthread_mutex_init(&store->lock, NULL);
    /* Another thread may have been first. */
    if (__atomic_compare_exchange_n(&root->pictures, &held, &store->service, false,
                                    __ATOMIC_ACQ_REL, __ATOMIC_ACQUIRE))
      held = &store->service;
    else
      destroy_store(&store->service);
  }
  *out = (cs_picture_store *)held;
  return CELSPAN_OK;
}

static celspan_status load_module(celspan_context *context, cs_picture_store *store,
                                  celspan_status failure) {
  if (store->module)
    return CELSPAN_OK;
  const void *table;
  CS_TRY(cs_module_load(context, &picture_module, failure, &table));
  const cs_picture_module *module = table;
  if (module->version != CS_PICTURE_MODULE_VERSION)
    return cs_fail(context, failure, "%s is of another version of celspan (%u, not %u)",
                   picture_module.file, module->version, CS_PICTURE_MODULE_VERSION);
  store->module = module;
  return CELSPAN_OK;
}

celspan_status cs_store_module(celspan_context *context, celspan_status failure,
                               const cs_picture_module **out) {
  cs_picture_store *store;
  CS_TRY(cs_store_get(context, &store));
  pthread_mutex_lock(&store->lock);
  celspan_status status = load_module(context, store, failure);
  pthread_mutex_unlock(&store->lock);
  if (status == CELSPAN_OK)
    *out = store->module;
  return status;
}

/* ---------------------------------------------------------------- blocks */

static size_t bucket_of(const cs_picture_store *store, const cs_picture_entry *entry, int level,
                        int32_t column, int32_t row) {
  uint64_t key = ((uint64_t)(uint32_t)column << 20 ^ (uint64_t)(uint32_t)row) * 0x9e3779b97f4a7c15u;
  key ^= ((uint64_t)entry->number * 32 + (uint64_t)level) * 0xc2b2ae3d27d4eb4fu;
  return (size_t)(key >> 32 ^ key >> 7) & (store->bucket_count - 1);
}

static cs_picture_block *find_block(const cs_picture_store *store, const cs_picture_entry *entry,
                                    int level, int32_t column, int32_t row) {
  if (!store->bucket_count)
    return NULL;
  cs_picture_block *block = store->buckets[bucket_of(store, entry, level, column, row)];
  while (block && !(block->entry == entry && block->level == level && block->column == column &&
                    block->row == row))
    block = block->next;
  return block;
}

static void list_remove(cs_picture_store *store, cs_picture_block *block) {
  *(block->older ? &block->older->newer : &store->oldest) = block->newer;
  *(block->newer ? &block->newer->older : &store->newest) = block->older;
  block->older = block->newer = NULL;
}

static void list_append(cs_picture_store *store, cs_picture_block *block) {
  block->older = store->newest;
  block->newer = NULL;
  *(store->newest ? &store->newest->newer : &store->oldest) = block;
  store->newest = block;
}

static void bucket_remove(cs_picture_store *store, cs_picture_block *block) {
  cs_picture_block **link =
      &store->buckets[bucket_of(store, block->entry, block->level, block->column, block->row)];
  while (*link != block)
    link = &(*link)->next;
  *link = block->next;
  store->block_count--;
}

static void free_block(cs_picture_store *store, cs_picture_block *block) {
  cs_mem_free(store->memory, block, sizeof *block);
  store->bytes -= sizeof *block;
}

/* Drops what was not used for longest until no more than `size` bytes are left, or nothing that can
 * be dropped. */
static void shrink(cs_picture_store *store, size_t size) {
  while (store->oldest && store->bytes > size) {
    cs_picture_block *block = store->oldest;
    list_remove(store, block);
    bucket_remove(store, block);
    free_block(store, block);
  }
}

static void make_room(cs_picture_store *store, size_t size) {
  shrink(store, store->budget > size ? store->budget - size : 0);
}

static void trim_store(cs_service *service) {
  cs_picture_store *store = (cs_picture_store *)service;
  pthread_mutex_lock(&store->lock);
  shrink(store, 0);
  pthread_mutex_unlock(&store->lock);
}

static bool grow_buckets(cs_picture_store *store) {
  if (store->block_count < store->bucket_count)
    return true;
  size_t old_count = store->bucket_count, new_count = old_count ? 2 * old_count : 1024;
  cs_picture_block **old = store->buckets;
  cs_picture_block **grown = cs_mem_array(store->memory, new_count, sizeof(cs_picture_block *));
  if (!grown)
    return old_count > 0;
  store->buckets = grown;
  store->bucket_count = new_count;
  for (size_t i = 0; i < old_count; i++)
    for (cs_picture_block *block = old[i], *next; block; block = next) {
      next = block->next;
      size_t to = bucket_of(store, block->entry, block->level, block->column, block->row);
      block->next = grown[to];
      grown[to] = block;
    }
  cs_mem_free(store->memory, old, old_count * sizeof(cs_picture_block *));
  return true;
}

static void pin(cs_picture_store *store, cs_picture_block *block) {
  if (block->pins++ == 0)
    list_remove(store, block);
}

cs_picture_block *cs_store_pin(cs_picture_store *store, const cs_picture_entry *entry, int level,
                               int32_t column, int32_t row) {
  pthread_mutex_lock(&store->lock);
  cs_picture_block *block = find_block(store, entry, level, column, row);
  if (block)
    pin(store, block);
  pthread_mutex_unlock(&store->lock);
  return block;
}

void cs_store_unpin(cs_picture_store *store, cs_picture_block *block) {
  pthread_mutex_lock(&store->lock);
  if (--block->pins == 0)
    list_append(store, block);
  pthread_mutex_unlock(&store->lock);
}

celspan_status cs_store_make(celspan_context *context, cs_picture_store *store,
                             cs_picture_entry *entry, int level, int32_t column, int32_t row,
                             cs_picture_block **out) {
  pthread_mutex_lock(&store->lock);
  make_room(store, sizeof(cs_picture_block));
  cs_picture_block *block =
      grow_buckets(store) ? cs_mem_array(store->memory, 1, sizeof(cs_picture_block)) : NULL;
  if (block)
    store->bytes += sizeof *block;
  pthread_mutex_unlock(&store->lock);
  if (!block)
    return cs_fail_memory(context);
  block->entry = entry;
  block->level = level;
  block->column = column;
  block->row = row;
  *out = block;
  return CELSPAN_OK;
}

cs_picture_block *cs_store_insert(cs_picture_store *store, cs_picture_block *block, uint32_t pins) {
  pthread_mutex_lock(&store->lock);
  cs_picture_block *held = find_block(store, block->entry, block->level, block->column, block->row);
  if (held) {
    free_block(store, block);
    if (pins)
      pin(store, held);
  } else {
    held = block;
    held->pins = pins;
    cs_picture_block **bucket =
        &store->buckets[bucket_of(store, held->entry, held->level, held->column, held->row)];
    held->next = *bucket;
    *bucket = held;
    store->block_count++;
    if (!pins)
      list_append(store, held);
  }
  pthread_mutex_unlock(&store->lock);
  return held;
}

void cs_store_discard(cs_picture_store *store, cs_picture_block *block) {
  if (!block)
    return;
  pthread_mutex_lock(&store->lock);
  free_block(store, block);
  pthread_mutex_unlock(&store->lock);
}

/* ---------------------------------------------------------------- entries */

static cs_picture_request request_of(const cs_picture *picture) {
  celspan_transfer transfer;
  bool is_space = picture->colour && !cs_transfer_parse(picture->colour, &transfer);
  return (cs_picture_request){.file = picture->file,
                              .layer = picture->layer,
                              .subimage = picture->subimage,
                              .space = is_space ? picture->colour : NULL};
}

static cs_picture_entry *find_entry(const cs_picture_store *store, cs_hash hash) {
  cs_picture_entry *entry = store->entries[hash.a & 255];
  while (entry && !(entry->hash.a == hash.a && entry->hash.b == hash.b))
    entry = entry->next;
  return entry;
}

static size_t blocks_across(int32_t size, int level) {
  return ((size_t)cs_levels_size(size, level) + CS_PICTURE_BLOCK - 1) / CS_PICTURE_BLOCK;
}

/* Rows of a frame run along a row of blocks, so with less than that each would read the file anew;
 * the quarter more is for the row of blocks that comes next. The caller holds the lock. */
static void plan_entry(cs_picture_store *store, cs_picture_entry *entry) {
  const celspan_picture_info *info = &entry->header.info;
  size_t least = blocks_across(info->width, 0) * sizeof(cs_picture_block) * 5 / 4;
  store->budget = store->budget < least ? least : store->budget;
  entry->share = store->budget / 2 / sizeof(cs_picture_block);
  entry->level_count = cs_levels_count(info->width, info->height);
  while (entry->base < entry->level_count - 1 &&
         blocks_across(info->width, entry->base) * blocks_across(info->height, entry->base) >
             entry->share)
    entry->base++;
}

/* Light by code, once for all pictures of a kind. The caller holds the lock. */
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

static bool set_decoder(cs_picture_store *store, cs_picture_entry *entry) {
  const cs_picture_header *header = &entry->header;
  const char *name = entry->picture->colour ? entry->picture->colour : header->info.colour;
  cs_levels_decoder *decoder = &entry->decoder;
  decoder->transfer = CELSPAN_TRANSFER_LINEAR;
  decoder->alpha = header->alpha;
  decoder->is_linear = header->is_linear;
  if (header->is_linear)
    return true;
  if (!cs_transfer_parse(name, &decoder->transfer) || header->bits < 1 || header->bits > 16)
    return true;
  decoder->codes = ((int32_t)1 << header->bits) - 1;
  decoder->table = find_table(store, decoder->transfer, header->bits);
  return decoder->table;
}

static celspan_status open_entry(celspan_context *context, cs_picture_store *store,
                                 const cs_picture *picture, cs_picture_entry **out) {
  cs_picture_request request = request_of(picture);
  cs_picture_failure failure;
  cs_picture_entry *entry = cs_mem_array(store->memory, 1, sizeof *entry);
  if (!entry)
    return cs_fail_memory(context);
  celspan_status status = store->module->open(&request, &entry->reader, &entry->header, &failure);
  if (status != CELSPAN_OK) {
    cs_mem_free(store->memory, entry, sizeof *entry);
    return cs_fail(context, status, "%s", failure.text);
  }
  pthread_mutex_init(&entry->reading, NULL);
  entry->picture = cs_picture_ref((cs_picture *)(uintptr_t)picture);
  entry->hash = picture->hash;
  entry->curve = &store->curve;
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

/* Closes readers that nobody uses until one more may be opened. The caller holds the lock. */
static void close_readers(cs_picture_store *store) {
  for (size_t i = 0; i < sizeof store->entries / sizeof *store->entries; i++)
    for (cs_picture_entry *entry = store->entries[i]; entry; entry = entry->next)
      if (store->reader_count >= OPEN_READERS)
        close_unused(store, entry);
}

/* The caller holds the lock. */
static bool keep_entry(cs_picture_store *store, cs_picture_entry *entry) {
  if (!set_decoder(store, entry))
    return false;
  plan_entry(store, entry);
  close_readers(store);
  store->reader_count++;
  entry->number = store->entry_count++;
  entry->next = store->entries[entry->hash.a & 255];
  store->entries[entry->hash.a & 255] = entry;
  return true;
}

static celspan_status add_entry(celspan_context *context, cs_picture_store *store,
                                const cs_picture *picture, cs_picture_entry **out) {
  const cs_picture_module *module;
  cs_picture_entry *entry;
  CS_TRY(cs_store_module(context, CELSPAN_INPUT, &module));
  CS_TRY(open_entry(context, store, picture, &entry));
  pthread_mutex_lock(&store->lock);
  cs_picture_entry *held = find_entry(store, picture->hash);
  bool is_kept = !held && keep_entry(store, entry);
  pthread_mutex_unlock(&store->lock);
  if (!is_kept)
    destroy_entry(store, entry);
  if (!is_kept && !held)
    return cs_fail_memory(context);
  *out = held ? held : entry;
  return CELSPAN_OK;
}

celspan_status cs_store_entry(celspan_context *context, cs_picture_store *store,
                              const cs_picture *picture, cs_picture_entry **out) {
  pthread_mutex_lock(&store->lock);
  cs_picture_entry *entry = find_entry(store, picture->hash);
  pthread_mutex_unlock(&store->lock);
  if (!entry)
    return add_entry(context, store, picture, out);
  *out = entry;
  return CELSPAN_OK;
}

static bool is_same_file(const cs_picture_header *a, const cs_picture_header *b) {
  return a->file_size == b->file_size && a->file_time == b->file_time &&
         a->file_number == b->file_number;
}

celspan_status cs_store_reader(celspan_context *context, cs_picture_store *store,
                               cs_picture_entry *entry) {
  if (entry->reader)
    return CELSPAN_OK;
  cs_picture_request request = request_of(entry->picture);
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

void cs_store_close(cs_picture_store *store, cs_picture_entry *entry) {
  if (!entry->reader)
    return;
  store->module->close(entry->reader);
  entry->reader = NULL;
  pthread_mutex_lock(&store->lock);
  store->reader_count--;
  pthread_mutex_unlock(&store->lock);
}
