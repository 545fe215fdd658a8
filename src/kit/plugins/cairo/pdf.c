/* Drawings as PDF through Cairo: a page is recorded, and written when it ends.
 *
 * A coordinate is on a grid of 1/256 point. All that is used here has a counterpart in PDF, so that
 * Cairo makes no pictures of its own. The file has no date: equal drawings have equal bytes.
 */
#include <cairo-pdf.h>
#include <stdlib.h>
#include <string.h>

#include "writers/parcels/plotter.h"

typedef struct cs_pdf {
  cs_pdf_output output;
  cairo_surface_t *surface;
  cairo_t *page; /* NULL: between two pages */
  double stroke; /* the stroke of the lines of the group */
  cs_plotter_picture picture;
  unsigned char *bytes; /* the bytes of its PNG file */
  size_t size, capacity, read;
  cairo_status_t failure; /* the first one outside of the page */
} cs_pdf;

static void fail(cs_pdf *pdf, cairo_status_t failure) {
  if (pdf->failure == CAIRO_STATUS_SUCCESS)
    pdf->failure = failure;
}

/* ---------------------------------------------------------------- paints */

static void add_stops(cairo_pattern_t *pattern, const cs_plotter_path *path) {
  for (size_t i = 0; i < path->fill->stop_count; i++) {
    const cs_fill_stop *stop = &path->stops[i];
    const unsigned char *code = stop->code;
    cairo_pattern_add_color_stop_rgba(pattern, stop->at, code[0] / 255.0, code[1] / 255.0,
                                      code[2] / 255.0, code[3] / 255.0);
  }
}

static cairo_pattern_t *make_linear(const cs_fill *fill) {
  return cairo_pattern_create_linear(fill->from.x, fill->from.y, fill->to.x, fill->to.y);
}

/* Cairo's matrix leads from the film to the gradient. */
static cairo_pattern_t *make_radial(const cs_fill *fill) {
  const double *m = fill->matrix;
  cairo_pattern_t *pattern = cairo_pattern_create_radial(0, 0, 0, fill->centre, 0, fill->radius);
  cairo_matrix_t matrix = {.xx = m[0], .xy = m[1], .x0 = m[2], .yx = m[3], .yy = m[4], .y0 = m[5]};
  if (cairo_matrix_invert(&matrix) == CAIRO_STATUS_SUCCESS)
    cairo_pattern_set_matrix(pattern, &matrix);
  return pattern;
}

static void set_paint(cairo_t *page, const cs_plotter_path *path) {
  const unsigned char *code = path->fill->code;
  if (path->fill->kind == CS_FILL_FLAT) {
    cairo_set_source_rgba(page, code[0] / 255.0, code[1] / 255.0, code[2] / 255.0,
                          path->kind == CS_PLOTTER_AREA ? code[3] / 255.0 : 1);
    return;
  }
  cairo_pattern_t *pattern =
      path->fill->kind == CS_FILL_LINEAR ? make_linear(path->fill) : make_radial(path->fill);
  add_stops(pattern, path);
  cairo_pattern_set_extend(pattern, CAIRO_EXTEND_PAD);
  cairo_set_source(page, pattern);
  cairo_pattern_destroy(pattern);
}

/* Cairo makes a paint where it is used. */
static void gradients(void *user, const cs_parcels *parcels) { (void)user, (void)parcels; }

/* ---------------------------------------------------------------- groups and paths */

/* The clip path before a group saves the state of the page. */
static void begin_group(void *user, const cs_plotter_group *group) {
  ((cs_pdf *)user)->stroke = group->stroke;
}

static void end_group(void *user, const cs_plotter_group *group) {
  if (group->clip)
    cairo_restore(((cs_pdf *)user)->page);
}

static void begin_path(void *user, const cs_plotter_path *path) {
  cairo_t *page = ((cs_pdf *)user)->page;
  if (path->kind == CS_PLOTTER_CLIP)
    cairo_save(page);
  else
    set_paint(page, path);
  cairo_new_path(page);
}

static void move(void *user, celspan_point to) {
  cairo_move_to(((cs_pdf *)user)->page, to.x, to.y);
}

static void line(void *user, celspan_point to) {
  cairo_line_to(((cs_pdf *)user)->page, to.x, to.y);
}

static void curve(void *user, const celspan_point points[3]) {
  cairo_curve_to(((cs_pdf *)user)->page, points[0].x, points[0].y, points[1].x, points[1].y,
                 points[2].x, points[2].y);
}

static void close_path(void *user) { cairo_close_path(((cs_pdf *)user)->page); }

static void end_path(void *user, const cs_plotter_path *path) {
  const cs_pdf *pdf = user;
  if (path->kind == CS_PLOTTER_AREA) {
    cairo_fill(pdf->page);
  } else if (path->kind == CS_PLOTTER_CLIP) {
    cairo_clip(pdf->page);
  } else {
    cairo_set_line_width(pdf->page, pdf->stroke);
    cairo_stroke(pdf->page);
  }
}

/* ---------------------------------------------------------------- pictures */

static void begin_picture(void *user, const cs_plotter_picture *picture) {
  cs_pdf *pdf = user;
  pdf->picture = *picture;
  pdf->size = pdf->read = 0;
}

static void bytes(void *user, const unsigned char *from, size_t size) {
  cs_pdf *pdf = user;
  if (pdf->failure != CAIRO_STATUS_SUCCESS)
    return;
  if (size > pdf->capacity - pdf->size) {
    size_t capacity = 2 * pdf->capacity + size;
    unsigned char *grown = realloc(pdf->bytes, capacity);
    if (!grown) {
      fail(pdf, CAIRO_STATUS_NO_MEMORY);
      return;
    }
    pdf->bytes = grown;
    pdf->capacity = capacity;
  }
  memcpy(pdf->bytes + pdf->size, from, size);
  pdf->size += size;
}

static cairo_status_t read_bytes(void *user, unsigned char *into, unsigned size) {
  cs_pdf *pdf = user;
  if (size > pdf->size - pdf->read)
    return CAIRO_STATUS_READ_ERROR;
  memcpy(into, pdf->bytes + pdf->read, size);
  pdf->read += size;
  return CAIRO_STATUS_SUCCESS;
}

/* Whether there is memory for the picture, what Cairo makes of it, and its packed bytes: it is
 * better not to begin than to run out in the middle of a library. */
static bool has_room(const cs_plotter_picture *picture) {
  const size_t columns = (size_t)picture->columns, rows = (size_t)picture->rows;
  if (rows > SIZE_MAX / 12 / columns)
    return false;
  /* volatile, because compilers leave out memory that is allocated and freed at once */
  void *volatile room = malloc(columns * rows * 12);
  const bool is_there = room != NULL;
  free(room);
  return is_there;
}

static void put_picture(cs_pdf *pdf, cairo_surface_t *picture) {
  const cs_plotter_picture *box = &pdf->picture;
  cairo_save(pdf->page);
  cairo_translate(pdf->page, box->x, box->y);
  cairo_scale(pdf->page, box->width / box->columns, box->height / box->rows);
  cairo_set_source_surface(pdf->page, picture, 0, 0);
  cairo_paint(pdf->page);
  cairo_restore(pdf->page);
}

static void end_picture(void *user) {
  cs_pdf *pdf = user;
  if (pdf->failure != CAIRO_STATUS_SUCCESS)
    return;
  if (!has_room(&pdf->picture)) {
    fail(pdf, CAIRO_STATUS_NO_MEMORY);
    return;
  }
  cairo_surface_t *picture = cairo_image_surface_create_from_png_stream(read_bytes, pdf);
  cairo_status_t status = cairo_surface_status(picture);
  if (status == CAIRO_STATUS_SUCCESS)
    put_picture(pdf, picture);
  else
    fail(pdf, status);
  cairo_surface_destroy(picture);
}

/* ---------------------------------------------------------------- pages */

static void begin_page(void *user, const cs_plotter_page *page) {
  cs_pdf *pdf = user;
  cairo_pdf_surface_set_size(pdf->surface, page->across, page->down);
  pdf->page = cairo_create(pdf->surface);
  cairo_scale(pdf->page, page->across / page->width, page->down / page->height);
  cairo_set_fill_rule(pdf->page, CAIRO_FILL_RULE_EVEN_ODD);
  cairo_set_line_cap(pdf->page, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(pdf->page, CAIRO_LINE_JOIN_ROUND);
}

static celspan_status judge(const cs_pdf *pdf, const char **reason) {
  if (pdf->failure == CAIRO_STATUS_SUCCESS)
    return CELSPAN_OK;
  *reason = cairo_status_to_string(pdf->failure);
  return pdf->failure == CAIRO_STATUS_NO_MEMORY ? CELSPAN_NO_MEMORY : CELSPAN_OUTPUT;
}

static void drop_page(cs_pdf *pdf) {
  if (pdf->page)
    cairo_destroy(pdf->page);
  pdf->page = NULL;
}

static celspan_status end_page(void *user, const char **reason) {
  cs_pdf *pdf = user;
  cairo_show_page(pdf->page);
  fail(pdf, cairo_status(pdf->page));
  fail(pdf, cairo_surface_status(pdf->surface));
  drop_page(pdf);
  return judge(pdf, reason);
}

/* ---------------------------------------------------------------- files */

static celspan_status close_file(void *user, const char **reason) {
  cs_pdf *pdf = user;
  drop_page(pdf);
  cairo_surface_finish(pdf->surface);
  fail(pdf, cairo_surface_status(pdf->surface));
  celspan_status status = judge(pdf, reason);
  cairo_surface_destroy(pdf->surface);
  free(pdf->bytes);
  free(pdf);
  return status;
}

static cairo_status_t put(void *user, const unsigned char *from, unsigned size) {
  const cs_pdf *pdf = user;
  return pdf->output.put(pdf->output.user, from, size) ? CAIRO_STATUS_SUCCESS
                                                       : CAIRO_STATUS_WRITE_ERROR;
}

/* A date that is no date is left out. */
static void set_facts(cairo_surface_t *surface, const cs_pdf_output *output) {
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATOR, output->maker);
  if (output->title)
    cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_TITLE, output->title);
  cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE, "");
}

/* The surface is opened at a size that each page changes. */
static celspan_status open_file(const cs_pdf_output *output, cs_plotter *out) {
  cs_pdf *pdf = calloc(1, sizeof *pdf);
  if (!pdf)
    return CELSPAN_NO_MEMORY;
  pdf->output = *output;
  pdf->surface = cairo_pdf_surface_create_for_stream(put, pdf, 1, 1);
  if (cairo_surface_status(pdf->surface) == CAIRO_STATUS_SUCCESS)
    set_facts(pdf->surface, output);
  *out = CS_PLOTTER(pdf);
  return CELSPAN_OK;
}

const void *celspan_pdf_module(void) {
  static const cs_pdf_module table = {CS_PDF_MODULE_VERSION, open_file};
  return &table;
}
