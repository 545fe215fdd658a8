/* JPEG of quality 95 without subsampling, by libjpeg. */
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>

#include <jpeglib.h>

#include "plugins/raster/write.h"

enum { QUALITY = 95, BUFFER = 1 << 16 };

typedef struct writing {
  struct jpeg_error_mgr manager; /* first: libjpeg knows only this part */
  struct jpeg_destination_mgr destination;
  struct jpeg_compress_struct jpeg;
  jmp_buf back;
  cs_write_target *target;
  size_t row;
  unsigned char buffer[BUFFER];
} writing;

static void note_error(j_common_ptr jpeg) { longjmp(((writing *)(void *)jpeg->err)->back, 1); }

static void ignore(j_common_ptr jpeg, int level) { (void)jpeg, (void)level; }

static void begin_buffer(j_compress_ptr jpeg) {
  writing *w = (writing *)(void *)jpeg->err;
  w->destination.next_output_byte = w->buffer;
  w->destination.free_in_buffer = BUFFER;
}

static boolean put_buffer(j_compress_ptr jpeg) {
  writing *w = (writing *)(void *)jpeg->err;
  if (!cs_write_put(w->target, w->buffer, BUFFER))
    longjmp(w->back, 1);
  begin_buffer(jpeg);
  return TRUE;
}

static void put_rest(j_compress_ptr jpeg) {
  writing *w = (writing *)(void *)jpeg->err;
  cs_write_put(w->target, w->buffer, BUFFER - w->destination.free_in_buffer);
}

static void set_form(writing *w, const cs_picture_output *output) {
  w->jpeg.image_width = (JDIMENSION)output->width;
  w->jpeg.image_height = (JDIMENSION)output->height;
  w->jpeg.input_components = output->channels;
  w->jpeg.in_color_space = output->channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&w->jpeg);
  jpeg_set_quality(&w->jpeg, QUALITY, TRUE);
  for (int i = 0; i < w->jpeg.num_components; i++)
    w->jpeg.comp_info[i].h_samp_factor = w->jpeg.comp_info[i].v_samp_factor = 1;
}

static bool start(writing *w, const cs_picture_output *output) {
  if (setjmp(w->back))
    return false;
  jpeg_create_compress(&w->jpeg);
  w->jpeg.dest = &w->destination;
  set_form(w, output);
  jpeg_start_compress(&w->jpeg, TRUE);
  return true;
}

static void destroy(void *self) {
  writing *w = self;
  jpeg_destroy_compress(&w->jpeg);
  free(w);
}

static void *begin(const cs_picture_output *output, cs_write_target *target) {
  writing *w = calloc(1, sizeof *w);
  if (!w)
    return NULL;
  w->target = target;
  w->row = cs_write_row(output);
  w->jpeg.err = jpeg_std_error(&w->manager);
  w->manager.error_exit = note_error;
  w->manager.emit_message = ignore;
  w->destination = (struct jpeg_destination_mgr){.init_destination = begin_buffer,
                                                 .empty_output_buffer = put_buffer,
                                                 .term_destination = put_rest};
  if (start(w, output))
    return w;
  destroy(w);
  return NULL;
}

static bool put_rows(void *self, int32_t count, const unsigned char *rows) {
  writing *w = self;
  if (setjmp(w->back))
    return false;
  for (int32_t i = 0; i < count; i++) {
    JSAMPROW row = (JSAMPROW)(size_t)(rows + (size_t)i * w->row);
    jpeg_write_scanlines(&w->jpeg, &row, 1);
  }
  return true;
}

static bool end(void *self) {
  writing *w = self;
  if (setjmp(w->back))
    return false;
  jpeg_finish_compress(&w->jpeg);
  return true;
}

const cs_write_format cs_write_jpeg = {"jpeg", begin, put_rows, end, destroy};
