/* A hash of all coded pixels: cs_sink_digest of output/sinks/sink.h. */
#include "base/hash.h"
#include "output/sinks/pixels.h"
#include "output/sinks/sink.h"

typedef struct digest_sink {
  celspan_coding coding;
  uint64_t *digest;
  cs_hash hash;
  size_t row_size;
  unsigned char *row;
} digest_sink;

static void destroy(digest_sink *sink, celspan_context *context) {
  cs_mem_free(context->memory, sink->row, sink->row_size);
  cs_mem_free(context->memory, sink, sizeof *sink);
}

static celspan_status begin(void *user, celspan_context *context, int32_t width, int32_t height) {
  digest_sink *sink = user;
  sink->row_size = (size_t)width * cs_pixels_size(&sink->coding);
  sink->row = cs_mem_resize(context->memory, NULL, 0, sink->row_size);
  if (!sink->row)
    return cs_fail_memory(context);
  cs_hash_word(&sink->hash, (uint64_t)width);
  cs_hash_word(&sink->hash, (uint64_t)height);
  cs_hash_word(&sink->hash, (uint64_t)sink->coding.depth);
  cs_hash_word(&sink->hash, (uint64_t)sink->coding.transfer);
  cs_hash_word(&sink->hash, (uint64_t)sink->coding.alpha);
  return CELSPAN_OK;
}

static celspan_status put_row(void *user, celspan_context *context, int32_t y,
                              const celspan_span *spans, size_t span_count) {
  digest_sink *sink = user;
  (void)context, (void)y;
  cs_pixels_row(&sink->coding, spans, span_count, sink->row);
  cs_hash_bytes(&sink->hash, sink->row, sink->row_size);
  return CELSPAN_OK;
}

static celspan_status end(void *user, celspan_context *context, celspan_status outcome) {
  digest_sink *sink = user;
  if (outcome == CELSPAN_OK) {
    cs_hash hash = cs_hash_end(sink->hash);
    sink->digest[0] = hash.a;
    sink->digest[1] = hash.b;
  }
  destroy(sink, context);
  return outcome;
}

celspan_status cs_sink_digest(celspan_context *context, const celspan_coding *coding,
                              uint64_t digest[2], celspan_sink *out) {
  digest_sink *sink;
  CS_TRY(CS_MAKE(context, sink, 1));
  sink->coding = cs_pixels_resolve(coding, CELSPAN_DEPTH_8);
  sink->digest = digest;
  sink->hash = cs_hash_begin(1);
  *out = (celspan_sink){CS_SINK_CALLS, .user = sink,
                        .takes_codes = cs_pixels_takes_codes(&sink->coding)};
  return CELSPAN_OK;
}
