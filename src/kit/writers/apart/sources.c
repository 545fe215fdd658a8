#include "writers/apart/sources.h"

#include "inside/frames.h"
#include "inside/sinks.h"
#include "inside/threads.h"

celspan_status cs_sources_begin(celspan_context *context, const celspan_coding *coding,
                                int32_t width, size_t count, cs_sources *out) {
  *out = (cs_sources){.context = context,
                      .coding = *coding,
                      .row = (size_t)width * cs_pixels_size(coding),
                      .count = count};
  return CS_MAKE(context, out->sources, count ? count : 1);
}

/* A failure of one frame becomes the failure of all. */
static celspan_status take(const cs_sources *sources, const cs_frame_source *source) {
  return source->status == CELSPAN_OK
             ? CELSPAN_OK
             : cs_fail(sources->context, source->status, "%s", source->context.error);
}

celspan_status cs_sources_open(cs_sources *sources, size_t index, const celspan_frame_desc *desc) {
  cs_frame_source *source = &sources->sources[index];
  cs_context_branch(&source->context, sources->context);
  source->status = celspan_rows_create(&source->context, desc, &source->rows);
  CS_TRY(take(sources, source));
  int workers = cs_rows_workers(source->rows);
  if (sources->workers == 0 || workers < sources->workers)
    sources->workers = workers;
  return CELSPAN_OK;
}

typedef struct turn {
  cs_sources *sources;
  cs_account_kind account;
  int32_t y, lines;
  unsigned char *pixels;
  size_t stride;
} turn;

static celspan_status make_rows(const turn *t, size_t index) {
  cs_sources *sources = t->sources;
  unsigned char *out = t->pixels + index * sources->row;
  for (int32_t i = 0; i < t->lines; i++, out += t->stride) {
    const celspan_span *spans;
    size_t span_count;
    CS_TRY(celspan_rows_get(sources->sources[index].rows, t->y + i, &spans, &span_count));
    cs_pixels_row(&sources->coding, spans, span_count, out);
  }
  return CELSPAN_OK;
}

static void make_source(void *user, int worker, int32_t index) {
  const turn *t = user;
  (void)worker;
  cs_account_set(t->sources->context->memory, t->account);
  t->sources->sources[index].status = make_rows(t, (size_t)index);
}

celspan_status cs_sources_make(cs_sources *sources, int32_t y, int32_t lines, unsigned char *pixels,
                               size_t stride) {
  turn t = {.sources = sources,
            .account = cs_account_of(sources->context->memory),
            .y = y,
            .lines = lines,
            .pixels = pixels,
            .stride = stride};
  cs_thread_pool_run(sources->workers, (int32_t)sources->count, make_source, &t);
  for (size_t i = 0; i < sources->count; i++)
    CS_TRY(take(sources, &sources->sources[i]));
  return CELSPAN_OK;
}

void cs_sources_finish(cs_sources *sources) {
  for (size_t i = 0; sources->sources && i < sources->count; i++)
    celspan_rows_destroy(sources->sources[i].rows);
  if (sources->sources)
    cs_mem_free(sources->context->memory, sources->sources,
                (sources->count ? sources->count : 1) * sizeof *sources->sources);
  *sources = (cs_sources){0};
}
