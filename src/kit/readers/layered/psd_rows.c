/* The rows of a layer in a Photoshop file. */
#include "readers/layered/psd.h"

#include <string.h>

#include "common/bytes.h"
#include "readers/layered/stream.h"

typedef struct channel_rows {
  const cs_psd_channel *channel;
  cs_stream_range data, sizes;
  cs_stream_inflate inflate;
  bool is_inflating;
  int bits;
  size_t row_size, packed_size;
  unsigned char *row, *packed; /* the latest row, and how it was packed */
} channel_rows;

typedef struct psd_rows {
  cs_rows base;
  const cs_input *input;
  int32_t y; /* the number of the next row in the layer */
  channel_rows channels[CS_PSD_CHANNELS];
} psd_rows;

/* ---------------------------------------------------------------- one channel */

static celspan_status fail(celspan_context *context, const psd_rows *rows,
                           const channel_rows *channel, const char *sentence) {
  return cs_input_fail(context, rows->input, channel->data.at, CELSPAN_INPUT, "%s", sentence);
}

/* False unless the packed bytes make exactly one row. */
static bool unpack_bits(const unsigned char *from, size_t size, unsigned char *row,
                        size_t row_size) {
  size_t at = 0, done = 0;
  while (at < size && done < row_size) {
    int head = (signed char)from[at++];
    size_t count = (size_t)(head < 0 ? 1 - head : head + 1);
    size_t taken = head < 0 ? 1 : count;
    if (head == -128) /* no operation */
      continue;
    if (count > row_size - done || taken > size - at)
      return false;
    if (head < 0)
      memset(row + done, from[at], count);
    else
      memcpy(row + done, from + at, count);
    at += taken;
    done += count;
  }
  return done == row_size;
}

static celspan_status next_packed(psd_rows *rows, celspan_context *context, channel_rows *channel) {
  unsigned char bytes[4] = {0};
  size_t count = (size_t)((const cs_psd_layer *)rows->base.source)->size_bytes;
  CS_TRY(cs_stream_read(&channel->sizes.base, context, bytes + 4 - count, count,
                        "a table of row sizes"));
  size_t size = cs_bytes_big32(bytes);
  if (size > channel->packed_size)
    return fail(context, rows, channel, "a packed row is longer than any can be");
  CS_TRY(cs_stream_read(&channel->data.base, context, channel->packed, size, "a packed row"));
  if (!unpack_bits(channel->packed, size, channel->row, channel->row_size))
    return fail(context, rows, channel, "a packed row has another length than its layer");
  return CELSPAN_OK;
}

/* Each value is the sum of the value on its left and the number in the file. */
static void add_up(channel_rows *channel) {
  unsigned char *row = channel->row;
  for (size_t i = 1; i < channel->row_size && channel->bits == 8; i++)
    row[i] = (unsigned char)(row[i] + row[i - 1]);
  for (size_t i = 2; i + 1 < channel->row_size && channel->bits == 16; i += 2) {
    unsigned sum = cs_bytes_big16(row + i) + (unsigned)cs_bytes_big16(row + i - 2);
    row[i] = (unsigned char)(sum >> 8);
    row[i + 1] = (unsigned char)sum;
  }
}

static celspan_status next_of_channel(psd_rows *rows, celspan_context *context,
                                      channel_rows *channel) {
  cs_psd_packing packing = channel->channel->packing;
  cs_stream *stream = channel->is_inflating ? &channel->inflate.base : &channel->data.base;
  if (packing == CS_PSD_PACK_BITS)
    return next_packed(rows, context, channel);
  CS_TRY(cs_stream_read(stream, context, channel->row, channel->row_size, "a channel"));
  if (packing == CS_PSD_ZIP_PREDICTED)
    add_up(channel);
  return CELSPAN_OK;
}

static void finish_channel(channel_rows *channel, cs_memory *memory) {
  if (channel->is_inflating)
    cs_stream_inflate_finish(&channel->inflate);
  cs_mem_free(memory, channel->row, channel->row_size);
  cs_mem_free(memory, channel->packed, channel->packed_size);
}

static celspan_status begin_channel(psd_rows *rows, celspan_context *context,
                                    const cs_psd_channel *channel, channel_rows *out) {
  cs_memory *memory = rows->base.memory;
  out->channel = channel;
  out->bits = rows->base.source->bits;
  out->row_size = (size_t)channel->width * (size_t)(out->bits / 8);
  /* PackBits adds at most one byte to 128; less efficient programs may double a row. */
  out->packed_size = 2 * out->row_size + 128;
  out->row = cs_mem_array(memory, out->row_size, 1);
  out->packed = cs_mem_array(memory, out->packed_size, 1);
  if (!out->row || !out->packed)
    return cs_fail_memory(context);
  cs_stream_range_init(&out->data, rows->input, channel->at, channel->end);
  cs_stream_range_init(&out->sizes, rows->input, channel->sizes, channel->at);
  if (channel->packing != CS_PSD_ZIP && channel->packing != CS_PSD_ZIP_PREDICTED)
    return CELSPAN_OK;
  CS_TRY(cs_stream_inflate_init(&out->inflate, context, &out->data.base, CS_STREAM_ZLIB));
  out->is_inflating = true;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- pixels */

static uint32_t value_at(const unsigned char *row, size_t x, int bits) {
  return bits == 16 ? cs_bytes_big16(row + 2 * x) : row[x];
}

/* The strength of the mask at column x of a row, from 0 to the greatest value. */
static uint32_t mask_at(const psd_rows *rows, int32_t x, bool has_row) {
  const cs_psd_layer *layer = (const cs_psd_layer *)rows->base.source;
  const cs_psd_channel *channel = &layer->channels[CS_PSD_MASK];
  const cs_psd_mask *mask = &layer->mask;
  uint32_t most = layer->base.bits == 16 ? 65535 : 255;
  int64_t column = (int64_t)x - mask->x;
  uint32_t value = mask->beyond * (most / 255);
  if (has_row && column >= 0 && column < channel->width)
    value = value_at(rows->channels[CS_PSD_MASK].row, (size_t)column, layer->base.bits);
  if (mask->is_inverted)
    value = most - value;
  return most - (uint32_t)((uint64_t)(most - value) * mask->density / 255);
}

static void put_values(uint32_t values[4], size_t x, int bits, void *row) {
  for (size_t c = 0; c < 4 && bits == 8; c++)
    ((unsigned char *)row)[4 * x + c] = (unsigned char)values[c];
  for (size_t c = 0; c < 4 && bits == 16; c++) {
    uint16_t value = (uint16_t)values[c];
    memcpy((unsigned char *)row + 8 * x + 2 * c, &value, sizeof value);
  }
}

static void put_row(const psd_rows *rows, bool has_mask_row, void *row) {
  const cs_psd_layer *layer = (const cs_psd_layer *)rows->base.source;
  int bits = layer->base.bits;
  uint32_t most = bits == 16 ? 65535 : 255;
  for (int32_t x = 0; x < layer->base.width; x++) {
    uint32_t values[4];
    for (int c = 0; c < 4; c++) {
      int from = layer->is_grey && c < 3 ? CS_PSD_RED : c;
      const unsigned char *channel = rows->channels[from].row;
      values[c] = channel ? value_at(channel, (size_t)x, bits) : most;
    }
    if (layer->channels[CS_PSD_MASK].is_there)
      values[3] =
          (uint32_t)(((uint64_t)values[3] * mask_at(rows, x, has_mask_row) + most / 2) / most);
    put_values(values, (size_t)x, bits, row);
  }
}

static celspan_status next(cs_rows *base, celspan_context *context, void *row) {
  psd_rows *rows = (psd_rows *)base;
  const cs_psd_layer *layer = (const cs_psd_layer *)base->source;
  const cs_psd_channel *mask = &layer->channels[CS_PSD_MASK];
  int64_t mask_row = (int64_t)rows->y++ - layer->mask.y;
  bool has_mask_row = mask->is_there && mask_row >= 0 && mask_row < mask->height;
  for (int c = 0; c < CS_PSD_CHANNELS; c++)
    if (layer->channels[c].is_there && (c != CS_PSD_MASK || has_mask_row))
      CS_TRY(next_of_channel(rows, context, &rows->channels[c]));
  put_row(rows, has_mask_row, row);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- life */

static void end(cs_rows *base) {
  psd_rows *rows = (psd_rows *)base;
  for (int c = 0; c < CS_PSD_CHANNELS; c++)
    finish_channel(&rows->channels[c], base->memory);
  cs_mem_free(base->memory, rows, sizeof *rows);
}

/* Skips the rows of the mask that lie above the layer. */
static celspan_status pass_mask_rows(psd_rows *rows, celspan_context *context) {
  const cs_psd_layer *layer = (const cs_psd_layer *)rows->base.source;
  const cs_psd_channel *mask = &layer->channels[CS_PSD_MASK];
  for (int32_t y = layer->mask.y; mask->is_there && y < 0 && y - layer->mask.y < mask->height; y++)
    CS_TRY(next_of_channel(rows, context, &rows->channels[CS_PSD_MASK]));
  return CELSPAN_OK;
}

static celspan_status begin(const cs_rows_source *source, celspan_context *context,
                            const cs_input *input, cs_rows **out) {
  const cs_psd_layer *layer = (const cs_psd_layer *)source;
  psd_rows *rows = cs_mem_array(source->memory, 1, sizeof *rows);
  if (!rows)
    return cs_fail_memory(context);
  rows->base = (cs_rows){source, source->memory};
  rows->input = input;
  celspan_status status = CELSPAN_OK;
  for (int c = 0; c < CS_PSD_CHANNELS && status == CELSPAN_OK; c++)
    if (layer->channels[c].is_there)
      status = begin_channel(rows, context, &layer->channels[c], &rows->channels[c]);
  if (status == CELSPAN_OK)
    status = pass_mask_rows(rows, context);
  return CS_GIVE(status, &rows->base, end, out);
}

static void destroy(cs_rows_source *source) {
  cs_mem_free(source->memory, source, sizeof(cs_psd_layer));
}

static const cs_rows_kind kind = {begin, next, end, destroy};

celspan_status cs_psd_rows_create(celspan_context *context, const cs_psd_layer *layer,
                                  cs_rows_source **out) {
  cs_psd_layer *source;
  CS_TRY(CS_MAKE(context, source, 1));
  *source = *layer;
  source->base.kind = &kind;
  source->base.memory = context->memory;
  *out = &source->base;
  return CELSPAN_OK;
}
