#include "output.h"

#include "crc32c.h"

enum { BUFFER_BYTES = 256 * 1024, NODE_BYTES = 4 + SF_NODE_ENTRIES * SF_ENTRY_BYTES };

typedef struct index_node {
  uint32_t count;
  unsigned char entries[SF_NODE_ENTRIES * SF_ENTRY_BYTES];
} index_node;

struct sf_output {
  bool (*write)(void *user, const void *bytes, size_t size);
  void *user;
  uint64_t flushed; /* bytes that were passed to `write` */
  size_t buffered;
  index_node nodes[SF_LEVELS];
  unsigned char record[SF_HEAD_BYTES + NODE_BYTES + SF_CHECK_BYTES];
  unsigned char buffer[BUFFER_BYTES];
};

size_t sf_record_seal(unsigned char *payload, size_t payload_size, unsigned char kind, uint32_t row,
                      unsigned char **start) {
  unsigned char head[1 + 10];
  head[0] = kind;
  size_t head_size = 1 + sf_store_varint(head + 1, payload_size);
  *start = payload - head_size;
  memcpy(*start, head, head_size);
  size_t size = head_size + payload_size;
  sf_store_32(*start + size, sf_crc32c_record(row, *start, size));
  return size + SF_CHECK_BYTES;
}

/* ---------------------------------------------------------------- bytes */

static void put_header(sf_output *out, const spanfile_writer_desc *desc) {
  unsigned char header[SF_HEADER_BYTES] = {0};
  header[0] = SF_ID_BYTES;
  header[2] = SF_IMAGE_TYPE;
  header[16] = (unsigned char)(8 * spanfile_pixel_size(desc->format));
  header[17] = 0x20 | (desc->format == SPANFILE_SRGB8 ? 8 : 0); /* from the top; bits of alpha */
  memcpy(header + 18, sf_magic, sizeof sf_magic);
  sf_store_32(header + 26, desc->width);
  sf_store_32(header + 30, desc->height);
  sf_store_32(header + 34, desc->format);
  sf_store_32(header + 38, desc->strip_row);
  sf_store_32(header + 42, sf_crc32c(0, header, 42));
  (void)sf_output_put(out, header, sizeof header); /* fits the buffer */
}

sf_output *sf_output_create(const sf_memory *memory, const spanfile_writer_desc *desc) {
  sf_output *out = sf_allocate(memory, sizeof *out);
  if (!out)
    return NULL;
  out->write = desc->write;
  out->user = desc->user;
  out->flushed = 0;
  out->buffered = 0;
  for (int level = 0; level < SF_LEVELS; level++)
    out->nodes[level].count = 0;
  put_header(out, desc);
  return out;
}

void sf_output_destroy(const sf_memory *memory, sf_output *out) {
  sf_release(memory, out, sizeof *out);
}

uint64_t sf_output_position(const sf_output *out) { return out->flushed + out->buffered; }

static bool write_out(sf_output *out, const void *bytes, size_t size) {
  if (size > 0 && !out->write(out->user, bytes, size))
    return false;
  out->flushed += size;
  return true;
}

static bool flush(sf_output *out) {
  size_t size = out->buffered;
  out->buffered = 0;
  return write_out(out, out->buffer, size);
}

bool sf_output_put(sf_output *out, const void *bytes, size_t size) {
  if (size > BUFFER_BYTES - out->buffered && !flush(out))
    return false;
  if (size > BUFFER_BYTES)
    return write_out(out, bytes, size);
  memcpy(out->buffer + out->buffered, bytes, size);
  out->buffered += size;
  return true;
}

/* ---------------------------------------------------------------- the index */

static bool put_node(sf_output *out, int level, uint64_t *offset) {
  const index_node *node = &out->nodes[level];
  size_t size = node->count * (size_t)SF_ENTRY_BYTES;
  unsigned char *payload = out->record + SF_HEAD_BYTES, *start;
  sf_store_32(payload, (uint32_t)level);
  memcpy(payload + 4, node->entries, size);
  *offset = sf_output_position(out);
  size = sf_record_seal(payload, 4 + size, SF_INDEX, SF_INDEX_ROW, &start);
  return sf_output_put(out, start, size);
}

static void add_entry(index_node *node, uint32_t row, uint64_t offset) {
  unsigned char *entry = node->entries + node->count++ * (size_t)SF_ENTRY_BYTES;
  sf_store_32(entry, row);
  sf_store_64(entry + 4, offset);
}

/* Writes a full node and adds an entry for it to the node one level higher, which has room. */
static bool pass_on(sf_output *out, int level) {
  uint64_t offset;
  index_node *node = &out->nodes[level];
  if (!put_node(out, level, &offset))
    return false;
  add_entry(&out->nodes[level + 1], sf_load_32(node->entries), offset);
  node->count = 0;
  return true;
}

/* Room for one more key row in the lowest node. */
static bool make_room(sf_output *out) {
  int full = 0;
  while (full < SF_LEVELS - 1 && out->nodes[full].count == SF_NODE_ENTRIES)
    full++;
  for (int level = full - 1; level >= 0; level--)
    if (!pass_on(out, level))
      return false;
  return true;
}

bool sf_output_key(sf_output *out, uint32_t row) {
  if (!make_room(out))
    return false;
  add_entry(&out->nodes[0], row, sf_output_position(out));
  return true;
}

/* Writes the nodes that are not full, the lowest first; the last one is the root. */
static bool finish_index(sf_output *out, uint64_t *root, int *levels) {
  int top = SF_LEVELS - 1;
  while (top > 0 && out->nodes[top].count == 0)
    top--;
  for (int level = 0; level < top; level++)
    if (out->nodes[level].count > 0 && !pass_on(out, level))
      return false;
  *levels = top + 1;
  return put_node(out, top, root);
}

/* ---------------------------------------------------------------- the end */

static bool put_end(sf_output *out, const spanfile_info *info, uint64_t root, int levels) {
  unsigned char trailer[SF_TRAILER_BYTES] = {0};
  memcpy(trailer, sf_end_magic, sizeof sf_end_magic);
  sf_store_64(trailer + 8, root);
  sf_store_64(trailer + 16, sf_output_position(out) + SF_END_BYTES);
  sf_store_32(trailer + 24, info->height);
  sf_store_32(trailer + 28, (uint32_t)levels);
  sf_store_32(trailer + 32, info->strip_height);
  sf_store_32(trailer + 36, sf_crc32c(0, trailer, 36));
  return sf_output_put(out, trailer, sizeof trailer) &&
         sf_output_put(out, sf_footer, sizeof sf_footer);
}

bool sf_output_end(sf_output *out, const spanfile_info *info) {
  uint64_t root;
  int levels;
  return finish_index(out, &root, &levels) && put_end(out, info, root, levels) && flush(out);
}
