#include "writers/parcels/plot_picture.h"

#include "inside/sinks.h"

static celspan_status draw_png(celspan_context *context, const char *path,
                               const cs_plot_picture *picture, cs_file *into) {
  celspan_file_desc file = CELSPAN_FILE_DESC;
  celspan_coding coding = CELSPAN_CODING;
  celspan_sink sink;
  coding.depth = CELSPAN_DEPTH_8;
  coding.space = picture->frame ? picture->frame->space : CELSPAN_SPACE_LINEAR;
  file.format = "png";
  file.coding = &coding;
  file.is_opaque = picture->is_opaque;
  CS_TRY(cs_sink_png_part(context, path, into, &file, &sink));
  return picture->draw(picture, context, &sink);
}

static celspan_status put_bytes(void *user, const void *bytes, size_t size) {
  const cs_plotter *to = user;
  to->bytes(to->user, bytes, size);
  return CELSPAN_OK;
}

static celspan_status put_png(celspan_context *context, const char *path,
                              const cs_plot_picture *picture, const cs_plotter *to) {
  cs_file *png;
  CS_TRY(cs_file_create(context, NULL, path, &png));
  celspan_status status = draw_png(context, path, picture, png);
  if (status == CELSPAN_OK)
    status = cs_file_again(png, context, put_bytes, (void *)to);
  cs_file_discard(png, context);
  return status;
}

celspan_status cs_plot_picture_put(celspan_context *context, const char *path,
                                   const cs_plot_picture *picture, celspan_point film,
                                   const cs_plotter *to) {
  const double x = film.x / picture->width, y = film.y / picture->height;
  const cs_plotter_picture box = {.x = picture->x * x,
                                  .y = picture->y * y,
                                  .width = picture->columns * x,
                                  .height = picture->rows * y,
                                  .columns = picture->columns,
                                  .rows = picture->rows};
  to->begin_picture(to->user, &box);
  CS_TRY(put_png(context, path, picture, to));
  to->end_picture(to->user);
  return CELSPAN_OK;
}
