#include "readers/layered/stream.h"

#include <string.h>

celspan_status cs_stream_read(cs_stream *stream, celspan_context *context, void *bytes, size_t size,
                              const char *what) {
  for (size_t done = 0, got; done < size; done += got) {
    CS_TRY(stream->pull(stream, context, (char *)bytes + done, size - done, &got));
    if (got == 0)
      return cs_input_fail(context, stream->input, -1, CELSPAN_INPUT,
                           "%s ends too early: %zu of %zu bytes are missing", what, size - done,
                           size);
  }
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- all of it */

/* Memory that grows while bytes arrive. */
typedef struct loaded {
  void *bytes;
  size_t capacity, size, most;
} loaded;

static celspan_status load(cs_stream *stream, celspan_context *context, const char *name,
                           loaded *out) {
  for (size_t got = 1; got > 0; out->size += got) {
    if (out->size > out->most)
      return cs_input_fail(context, stream->input, -1, CELSPAN_LIMIT,
                           "\"%s\" unpacks to more than %zu bytes, which is the limit for it", name,
                           out->most);
    CS_TRY(cs_mem_reserve(context, &out->bytes, &out->capacity, out->size + CS_STREAM_BUFFER, 1));
    CS_TRY(stream->pull(stream, context, (unsigned char *)out->bytes + out->size,
                        out->capacity - out->size, &got));
  }
  return CELSPAN_OK;
}

/* Shrinks the memory to its contents and passes it to the caller. A NUL follows the contents. */
static celspan_status shrink(celspan_context *context, loaded *found, unsigned char **out,
                             size_t *size) {
  unsigned char *bytes =
      cs_mem_resize(context->memory, found->bytes, found->capacity, found->size + 1);
  if (!bytes)
    return cs_fail_memory(context);
  bytes[found->size] = 0;
  *out = bytes;
  *size = found->size;
  return CELSPAN_OK;
}

celspan_status cs_stream_load(cs_stream *stream, celspan_context *context, const char *name,
                              size_t most, unsigned char **out, size_t *size) {
  loaded found = {.most = most};
  celspan_status status = load(stream, context, name, &found);
  if (status == CELSPAN_OK)
    status = shrink(context, &found, out, size);
  if (status != CELSPAN_OK)
    cs_mem_free(context->memory, found.bytes, found.capacity);
  return status;
}

/* ---------------------------------------------------------------- a part of a file */

static celspan_status refill(cs_stream_range *range, celspan_context *context) {
  int64_t left = range->end - range->at;
  size_t count = left < CS_STREAM_BUFFER ? (size_t)left : CS_STREAM_BUFFER;
  CS_TRY(cs_input_read(context, range->base.input, range->at, range->buffer, count));
  range->at += (int64_t)count;
  range->next = 0;
  range->count = count;
  return CELSPAN_OK;
}

static celspan_status pull_range(cs_stream *stream, celspan_context *context, void *bytes,
                                 size_t size, size_t *got) {
  cs_stream_range *range = (cs_stream_range *)stream;
  *got = 0;
  if (range->next == range->count && range->at >= range->end)
    return CELSPAN_OK;
  if (range->next == range->count)
    CS_TRY(refill(range, context));
  size_t ready = range->count - range->next;
  *got = size < ready ? size : ready;
  memcpy(bytes, range->buffer + range->next, *got);
  range->next += *got;
  return CELSPAN_OK;
}

void cs_stream_range_init(cs_stream_range *range, const cs_input *input, int64_t at, int64_t end) {
  range->base = (cs_stream){pull_range, input};
  range->at = at;
  range->end = end;
  range->next = range->count = 0;
}

/* ---------------------------------------------------------------- inflating */

/* zlib frees blocks without giving their size, so the size is stored before each block. */
typedef union allocation_head {
  size_t size;
  max_align_t aligned;
} allocation_head;

static void *take(void *user, unsigned count, unsigned size) {
  size_t bytes = sizeof(allocation_head) + (size_t)count * size;
  allocation_head *head = cs_mem_resize(user, NULL, 0, bytes);
  if (!head)
    return NULL;
  head->size = bytes;
  return head + 1;
}

static void give_back(void *user, void *block) {
  allocation_head *head = (allocation_head *)block - 1;
  cs_mem_free(user, head, head->size);
}

static celspan_status pull_inflated(cs_stream *base, celspan_context *context, void *bytes,
                                    size_t size, size_t *got) {
  cs_stream_inflate *stream = (cs_stream_inflate *)base;
  z_stream *zlib = &stream->zlib;
  unsigned wanted = size < UINT32_MAX / 2 ? (unsigned)size : UINT32_MAX / 2;
  zlib->next_out = bytes;
  zlib->avail_out = wanted;
  while (zlib->avail_out == wanted && !stream->is_ended) {
    size_t count = zlib->avail_in;
    if (count == 0) {
      CS_TRY(
          stream->source->pull(stream->source, context, stream->buffer, CS_STREAM_BUFFER, &count));
      zlib->next_in = stream->buffer;
      zlib->avail_in = (unsigned)count;
    }
    int outcome = inflate(zlib, Z_NO_FLUSH);
    if (outcome == Z_MEM_ERROR)
      return cs_fail_memory(context);
    if (outcome != Z_OK && outcome != Z_STREAM_END && (outcome != Z_BUF_ERROR || count == 0))
      return cs_input_fail(context, base->input, -1, CELSPAN_INPUT,
                           "compressed data is damaged (%s)",
                           zlib->msg ? zlib->msg : "it ends too early");
    stream->is_ended = outcome == Z_STREAM_END;
  }
  *got = wanted - zlib->avail_out;
  return CELSPAN_OK;
}

celspan_status cs_stream_inflate_init(cs_stream_inflate *stream, celspan_context *context,
                                      cs_stream *source, cs_stream_wrapping wrapping) {
  stream->base = (cs_stream){pull_inflated, source->input};
  stream->source = source;
  stream->memory = context->memory;
  stream->is_ended = false;
  stream->zlib = (z_stream){.zalloc = take, .zfree = give_back, .opaque = context->memory};
  int bits = wrapping == CS_STREAM_ZLIB ? MAX_WBITS : -MAX_WBITS;
  return inflateInit2(&stream->zlib, bits) == Z_OK ? CELSPAN_OK : cs_fail_memory(context);
}

void cs_stream_inflate_finish(cs_stream_inflate *stream) { inflateEnd(&stream->zlib); }
