/* The steps that all files with layers have in common. */
#include "inside/frames.h"
#include "inside/sinks.h"
#include "writers/apart/apart.h"

/* ---------------------------------------------------------------- pictures */

static bool report(void *user, int32_t rows_done, int32_t rows_total) {
  const cs_apart_writing *writing = user;
  const celspan_frame_desc *frame = &writing->frame;
  double share = (double)rows_done / rows_total;
  double rows = rows_total * ((double)writing->done - 1 + share) / (double)writing->count;
  return frame->progress(frame->progress_user, (int32_t)rows, rows_total);
}

void cs_apart_report_to(cs_apart_writing *writing, celspan_frame_desc *picture) {
  writing->done++;
  if (!writing->frame.progress)
    return;
  picture->progress = report;
  picture->progress_user = writing;
}

celspan_status cs_apart_render(cs_apart_writing *writing, const celspan_frame_desc *picture,
                               celspan_sink *sink) {
  celspan_frame_desc frame = *picture;
  cs_apart_report_to(writing, &frame);
  return cs_frame_render_own(writing->context, &frame, sink, NULL);
}

static celspan_status put_picture(cs_apart_writing *writing, size_t index) {
  celspan_frame_desc picture = writing->frame;
  if (index > 0) {
    picture.exposures = writing->apart.layers[index - 1].exposures;
    picture.exposure_count = writing->apart.layers[index - 1].count;
  }
  return writing->format->put(writing, &picture, index);
}

/* ---------------------------------------------------------------- all */

static celspan_status make_layers(cs_apart_writing *writing) {
  const celspan_frame_desc *frame = &writing->frame;
  const cs_apart_format *format = writing->format;
  if (writing->contents.has_layers)
    CS_TRY(cs_apart_make(writing->context, frame->exposures, frame->exposure_count, writing->suffix,
                         &writing->apart));
  writing->count = writing->apart.count + 1;
  return format->has_mode ? cs_apart_take_mixings(&writing->apart, format->steps) : CELSPAN_OK;
}

static celspan_status put_all(cs_apart_writing *writing) {
  if (writing->format->begin)
    CS_TRY(writing->format->begin(writing));
  for (size_t i = 0; i <= writing->apart.count; i++)
    CS_TRY(put_picture(writing, i));
  return CELSPAN_OK;
}

static celspan_status write_all(cs_apart_writing *writing) {
  const cs_apart_format *format = writing->format;
  if (format->check)
    CS_TRY(format->check(writing));
  CS_TRY(make_layers(writing));
  celspan_status status = put_all(writing);
  return format->end ? format->end(writing, status) : status;
}

celspan_status cs_apart_write(celspan_context *context, const cs_apart_format *format,
                              cs_apart_contents contents, const celspan_frame_desc *desc,
                              const char *path, const celspan_file_desc *file) {
  CS_TRY(cs_frame_check(context, desc));
  cs_apart_writing *writing;
  CS_TRY(cs_mem_make(context, (void **)&writing, 1, format->size));
  *writing = (cs_apart_writing){.context = context,
                                .format = format,
                                .contents = contents,
                                .frame = *desc,
                                .path = path,
                                .file = *file,
                                .coding = cs_pixels_resolve(file->coding, format->depth),
                                .width = desc->crop_width > 0 ? desc->crop_width : desc->width,
                                .height = desc->crop_height > 0 ? desc->crop_height : desc->height};
  writing->coding.space = desc->space;
  celspan_status status = write_all(writing);
  cs_apart_finish(&writing->apart);
  cs_mem_free(context->memory, writing, format->size);
  return status;
}
