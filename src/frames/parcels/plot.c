#include "frames/parcels/plot.h"

#include <math.h>
#include <string.h>
#include <strings.h>

#include "frames/parcels/boxes.h"
#include "frames/parcels/plot_text.h"
#include "frames/parcels/under.h"
#include "frames/plane/plane.h"
#include "frames/render/frame.h"
#include "model/scene/check.h"

#define GROWN 1.6     /* pixels: how far an area continues under another one */
#define OPAQUE 0.999f /* alpha, rounded */
enum { PICTURE_SIDE = 16384 /* pixels, at most */, PROOF_SIDE = 512 };
enum { CODE_DIGITS = 4, STOP_DIGITS = 6, SPARE_DIGITS = 3, MATRIX_DIGITS = 9 };

bool cs_plot_is_wanted(const char *path, const char *format) {
  return strcasecmp(format ? format : cs_file_ending(path), "svg") == 0;
}

/* A drawing that is being written. */
typedef struct drawing {
  cs_plot_text text;
  const cs_plot_desc *desc;
  const celspan_plane *plane;
  cs_parcels parcels;
  cs_under under;
  cs_plot_facts *facts;
} drawing;

/* ---------------------------------------------------------------- paints */

static void put_pair(drawing *d, const char *x, const char *y, celspan_point at) {
  cs_plot_put(&d->text, " %s=\"", x);
  cs_plot_put_number(&d->text, at.x, d->desc->precision + SPARE_DIGITS);
  cs_plot_put(&d->text, "\" %s=\"", y);
  cs_plot_put_number(&d->text, at.y, d->desc->precision + SPARE_DIGITS);
  cs_plot_put(&d->text, "\"");
}

static void put_code(drawing *d, const char *name, const unsigned char code[4]) {
  cs_plot_put(&d->text, " %s=\"#%02x%02x%02x\"", name, code[0], code[1], code[2]);
}

static void put_alpha(drawing *d, const char *name, const unsigned char code[4]) {
  if (code[3] == 255)
    return;
  cs_plot_put(&d->text, " %s=\"", name);
  cs_plot_put_number(&d->text, code[3] / 255.0, CODE_DIGITS);
  cs_plot_put(&d->text, "\"");
}

static void put_stops(drawing *d, const cs_fill *fill) {
  for (size_t i = 0; i < fill->stop_count; i++) {
    const cs_fill_stop *stop = &d->parcels.stops[fill->stop + i];
    cs_plot_put(&d->text, "<stop offset=\"");
    cs_plot_put_number(&d->text, stop->at, STOP_DIGITS);
    cs_plot_put(&d->text, "\"");
    put_code(d, "stop-color", stop->code);
    put_alpha(d, "stop-opacity", stop->code);
    cs_plot_put(&d->text, "/>");
  }
}

static void put_radial(drawing *d, const cs_fill *fill) {
  static const int columns[6] = {0, 3, 1, 4, 2, 5};
  cs_plot_put(&d->text, " cx=\"");
  cs_plot_put_number(&d->text, fill->centre, MATRIX_DIGITS);
  cs_plot_put(&d->text, "\" cy=\"0\" r=\"");
  cs_plot_put_number(&d->text, fill->radius, MATRIX_DIGITS);
  cs_plot_put(&d->text, "\" fx=\"0\" fy=\"0\" gradientTransform=\"matrix(");
  for (int i = 0; i < 6; i++) {
    cs_plot_put(&d->text, i > 0 ? " " : "");
    cs_plot_put_number(&d->text, fill->matrix[columns[i]], MATRIX_DIGITS);
  }
  cs_plot_put(&d->text, ")\"");
}

static void put_gradient(drawing *d, size_t number) {
  const cs_fill *fill = &d->parcels.fills[number];
  const char *name = fill->kind == CS_FILL_LINEAR ? "linearGradient" : "radialGradient";
  cs_plot_put(&d->text, "<%s id=\"g%zu\" gradientUnits=\"userSpaceOnUse\"", name, number);
  if (fill->kind == CS_FILL_LINEAR) {
    put_pair(d, "x1", "y1", fill->from);
    put_pair(d, "x2", "y2", fill->to);
  } else {
    put_radial(d, fill);
  }
  cs_plot_put(&d->text, ">");
  put_stops(d, fill);
  cs_plot_put(&d->text, "</%s>\n", name);
}

static void put_gradients(drawing *d) {
  bool has_one = false;
  for (size_t i = 0; i < d->parcels.fill_count; i++) {
    cs_fill_kind kind = d->parcels.fills[i].kind;
    if (kind != CS_FILL_LINEAR && kind != CS_FILL_RADIAL)
      continue;
    cs_plot_put(&d->text, has_one ? "" : "<defs>\n");
    has_one = true;
    put_gradient(d, i);
  }
  cs_plot_put(&d->text, has_one ? "</defs>\n" : "");
}

/* name: fill or stroke. */
static void put_paint(drawing *d, const char *name, uint32_t number) {
  const cs_fill *fill = &d->parcels.fills[number];
  if (fill->kind == CS_FILL_FLAT)
    put_code(d, name, fill->code);
  else
    cs_plot_put(&d->text, " %s=\"url(#g%u)\"", name, (unsigned)number);
}

/* ---------------------------------------------------------------- pictures */

static celspan_status send_rows(celspan_context *context, const celspan_plane *plane,
                                const celspan_plane_view *view, const celspan_sink *sink) {
  cs_plane_rows *rows;
  CS_TRY(cs_plane_rows_create(context, plane, view, &rows));
  celspan_status status = sink->begin(sink->user, context, view->crop_width, view->crop_height);
  for (int32_t y = 0; y < view->crop_height && status == CELSPAN_OK; y++) {
    const celspan_span *spans;
    size_t count;
    status = cs_plane_rows_get(rows, y, &spans, &count);
    if (status == CELSPAN_OK)
      status = sink->row(sink->user, context, y, spans, count);
  }
  cs_plane_rows_destroy(rows);
  return status;
}

/* The sink is ended whatever happens. */
static celspan_status draw_plane(const cs_plot_picture *picture, celspan_context *context,
                                 const celspan_sink *sink) {
  celspan_plane_view view = CELSPAN_PLANE_VIEW;
  view.width = picture->width;
  view.height = picture->height;
  view.crop_x = picture->x;
  view.crop_y = picture->y;
  view.crop_width = picture->columns;
  view.crop_height = picture->rows;
  view.antialias = CELSPAN_ANTIALIAS_AREA;
  celspan_status status = send_rows(context, picture->plane, &view, sink);
  celspan_status last = sink->end(sink->user, context, status);
  return status == CELSPAN_OK ? last : status;
}

static celspan_status draw_frame(const cs_plot_picture *picture, celspan_context *context,
                                 const celspan_sink *sink) {
  celspan_frame_desc frame = *picture->frame;
  celspan_sink own = *sink;
  frame.width = picture->width;
  frame.height = picture->height;
  frame.crop_x = frame.crop_y = frame.crop_width = frame.crop_height = 0;
  return cs_frame_render_own(context, &frame, &own, NULL);
}

/* The picture of a film, whole. */
static celspan_status size_picture(celspan_context *context, double width, double height,
                                   double scale, cs_plot_picture *out) {
  const double columns = fmax(ceil(width * scale), 1), rows = fmax(ceil(height * scale), 1);
  if (columns > INT32_MAX || rows > INT32_MAX)
    return cs_fail(context, CELSPAN_LIMIT,
                   "at this scale the film would have %.0f x %.0f pixels; a side has at most %d: "
                   "give a smaller --scale",
                   columns, rows, (int)INT32_MAX);
  out->width = out->columns = (int32_t)columns;
  out->height = out->rows = (int32_t)rows;
  return CELSPAN_OK;
}

static celspan_status check_picture(celspan_context *context, const cs_plot_picture *picture) {
  if (picture->columns <= PICTURE_SIDE && picture->rows <= PICTURE_SIDE)
    return CELSPAN_OK;
  return cs_fail(context, CELSPAN_LIMIT,
                 "a picture in the drawing would have %d x %d pixels; a side has at most %d: "
                 "give a smaller --scale",
                 (int)picture->columns, (int)picture->rows, PICTURE_SIDE);
}

/* The columns or rows that a range of units touches. */
static void clip_side(double low, double high, double film, int32_t side, int32_t *first,
                      int32_t *end) {
  double begin = floor(low / film * side), last = ceil(high / film * side);
  *first = begin < 0 ? 0 : begin < side ? (int32_t)begin : side - 1;
  *end = last > side ? side : last > *first ? (int32_t)last : *first + 1;
}

/* The part of the whole picture in which a loop lies. */
static cs_box box_of(const cs_parcels *parcels, const cs_parcel_loop *loop,
                     const cs_plot_picture *whole) {
  celspan_point least = {INFINITY, INFINITY}, most = {-INFINITY, -INFINITY};
  cs_box box;
  for (size_t k = loop->walk; k < loop->walk + loop->walk_count; k++) {
    const cs_parcel_arc *arc = &parcels->arcs[parcels->walks[k].arc];
    for (size_t c = 4 * arc->curve; c < 4 * (arc->curve + arc->curve_count); c++) {
      celspan_point at = parcels->curves[c / 4].points[c % 4];
      least = (celspan_point){fmin(least.x, at.x), fmin(least.y, at.y)};
      most = (celspan_point){fmax(most.x, at.x), fmax(most.y, at.y)};
    }
  }
  clip_side(least.x, most.x, parcels->width, whole->width, &box.x0, &box.x1);
  clip_side(least.y, most.y, parcels->height, whole->height, &box.y0, &box.y1);
  return box;
}

/* The union of all fills that are wanted: loops, from the first one to the end. */
static celspan_status unite(drawing *d, bool (*is_wanted)(const cs_fill *fill), size_t loops[2]) {
  cs_parcels *p = &d->parcels;
  uint32_t *sets;
  CS_TRY(CS_MAKE(d->text.context, sets, p->fill_count));
  for (size_t i = 0; i < p->fill_count; i++)
    sets[i] = is_wanted(&p->fills[i]);
  celspan_status status = cs_parcels_walk(d->text.context, p, sets, 1, loops);
  cs_mem_free(d->text.context->memory, sets, p->fill_count * sizeof *sets);
  return status;
}

static void put_clip(drawing *d, const char *name, const size_t loops[2]) {
  cs_plot_put(&d->text, "<clipPath id=\"%s\"><path clip-rule=\"evenodd\" d=\"", name);
  cs_plot_begin_path(&d->text);
  cs_plot_loops(&d->text, &d->parcels, loops[0], loops[1] - loops[0]);
  cs_plot_put(&d->text, "\"/></clipPath>\n");
}

static bool is_picture(const cs_fill *fill) { return fill->kind == CS_FILL_PICTURE; }

static celspan_status put_part(drawing *d, cs_plot_picture picture, const cs_box *part) {
  cs_plot_facts *facts = d->facts;
  picture.x = part->x0;
  picture.y = part->y0;
  picture.columns = part->x1 - part->x0;
  picture.rows = part->y1 - part->y0;
  CS_TRY(check_picture(d->text.context, &picture));
  cs_plot_put_picture(&d->text, &picture, d->parcels.width, d->parcels.height);
  facts->pictures++;
  if ((double)picture.columns * picture.rows >
      (double)facts->picture_width * facts->picture_height) {
    facts->picture_width = picture.columns;
    facts->picture_height = picture.rows;
  }
  return CELSPAN_OK;
}

/* Parts that are apart are pictures of their own. */
static celspan_status put_pictures(drawing *d) {
  size_t loops[2];
  cs_boxes parts = {.count = 0};
  cs_plot_picture picture = {
      .draw = draw_plane, .plane = d->plane, .is_opaque = celspan_plane_is_opaque(d->plane)};
  CS_TRY(unite(d, is_picture, loops));
  if (loops[0] == loops[1])
    return CELSPAN_OK;
  CS_TRY(
      size_picture(d->text.context, d->parcels.width, d->parcels.height, d->desc->scale, &picture));
  for (size_t i = loops[0]; i < loops[1]; i++)
    cs_boxes_add(&parts, box_of(&d->parcels, &d->parcels.loops[i], &picture));
  put_clip(d, "picture", loops);
  cs_plot_put(&d->text, "<g clip-path=\"url(#picture)\">\n");
  for (size_t i = 0; i < parts.count; i++)
    CS_TRY(put_part(d, picture, &parts.all[i]));
  cs_plot_put(&d->text, "</g>\n");
  return CELSPAN_OK;
}

/* Whether nothing shines through a plane anywhere, by its pixels. */
static celspan_status prove_opaque(const drawing *d, bool *is_opaque) {
  celspan_plane_view view = CELSPAN_PLANE_VIEW;
  cs_plane_rows *rows;
  view.width = view.crop_width = view.height = view.crop_height = PROOF_SIDE;
  view.antialias = CELSPAN_ANTIALIAS_AREA;
  CS_TRY(cs_plane_rows_create(d->text.context, d->plane, &view, &rows));
  celspan_status status = CELSPAN_OK;
  *is_opaque = true;
  for (int32_t y = 0; y < PROOF_SIDE && *is_opaque && status == CELSPAN_OK; y++) {
    const celspan_span *spans;
    size_t count = 0;
    float colour[4];
    status = cs_plane_rows_get(rows, y, &spans, &count);
    for (size_t i = 0; i < count; i++)
      for (int32_t x = spans[i].x0; x < spans[i].x1; x++) {
        celspan_span_colour(&spans[i], x, colour);
        *is_opaque &= colour[3] > OPAQUE;
      }
  }
  cs_plane_rows_destroy(rows);
  return status;
}

/* What vectors cannot say is opaque if all is. */
static celspan_status judge_pictures(drawing *d) {
  cs_parcels *p = &d->parcels;
  bool is_certain = true, is_opaque = true;
  for (size_t i = 0; i < p->fill_count; i++)
    is_certain &= !is_picture(&p->fills[i]) || p->fills[i].is_opaque;
  if (!is_certain)
    CS_TRY(prove_opaque(d, &is_opaque));
  for (size_t i = 0; i < p->fill_count && is_opaque; i++)
    p->fills[i].is_opaque |= is_picture(&p->fills[i]);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- areas */

static void put_area(drawing *d, uint32_t number) {
  const cs_fill *fill = &d->parcels.fills[number];
  if (fill->loop_count == 0 || is_picture(fill))
    return;
  cs_plot_put(&d->text, "<path");
  put_paint(d, "fill", number);
  if (fill->kind == CS_FILL_FLAT)
    put_alpha(d, "fill-opacity", fill->code);
  cs_plot_put(&d->text, " d=\"");
  cs_plot_begin_path(&d->text);
  cs_plot_loops(&d->text, &d->parcels, fill->loop, fill->loop_count);
  cs_plot_put(&d->text, "\"/>\n");
  d->facts->areas++;
}

static celspan_status put_areas(drawing *d) {
  cs_plot_put(&d->text, "<g fill-rule=\"evenodd\">\n");
  for (size_t i = d->parcels.fill_count; i-- > 0;)
    put_area(d, d->under.order[i]);
  CS_TRY(put_pictures(d));
  cs_plot_put(&d->text, "</g>\n");
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- under them */

static void put_line(drawing *d, const cs_under_line *line) {
  const cs_parcel_walk walk = {line->arc, false};
  cs_plot_move(&d->text, line->is_flat ? line->from : cs_parcel_begin(&d->parcels, walk));
  if (line->is_flat)
    cs_plot_line(&d->text, line->to);
  else
    cs_plot_arc(&d->text, &d->parcels, walk);
}

/* How far an area continues, in units. */
static double growth(const drawing *d) {
  double x = d->desc->width > 0 ? d->parcels.width / d->desc->width : 1;
  double y = d->desc->height > 0 ? d->parcels.height / d->desc->height : 1;
  return GROWN * fmax(x, y);
}

static celspan_status put_under(drawing *d) {
  const cs_under *under = &d->under;
  /* where not all of the frame is opaque, strokes must not be seen beside what is */
  const bool has_clip = under->opaque < d->parcels.width * d->parcels.height * (1 - 1e-7);
  size_t loops[2];
  if (under->line_count == 0)
    return CELSPAN_OK;
  if (has_clip) {
    CS_TRY(unite(d, cs_under_suits, loops));
    put_clip(d, "opaque", loops);
  }
  cs_plot_put(&d->text,
              "<g fill=\"none\" stroke-linecap=\"round\" stroke-linejoin=\"round\"%s "
              "stroke-width=\"",
              has_clip ? " clip-path=\"url(#opaque)\"" : "");
  cs_plot_put_number(&d->text, 2 * growth(d), d->desc->precision + SPARE_DIGITS);
  cs_plot_put(&d->text, "\">\n");
  for (size_t i = 0; i < under->line_count; i++) {
    bool is_first = i == 0 || under->lines[i - 1].rank != under->lines[i].rank;
    if (is_first) {
      cs_plot_put(&d->text, i > 0 ? "\"/>\n<path" : "<path");
      put_paint(d, "stroke", under->order[under->lines[i].rank]);
      cs_plot_put(&d->text, " d=\"");
      cs_plot_begin_path(&d->text);
    }
    put_line(d, &under->lines[i]);
  }
  cs_plot_put(&d->text, "\"/>\n</g>\n");
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- files */

static celspan_status begin(celspan_context *context, const char *path, const cs_plot_desc *desc,
                            double width, double height, cs_plot_text *out) {
  *out = (cs_plot_text){.context = context, .path = path, .precision = desc->precision};
  CS_TRY(cs_file_create(context, NULL, path, &out->file));
  cs_plot_put(out, "<svg xmlns=\"http://www.w3.org/2000/svg\" "
                   "xmlns:xlink=\"http://www.w3.org/1999/xlink\" viewBox=\"0 0 ");
  cs_plot_put_number(out, width, MATRIX_DIGITS);
  cs_plot_put(out, " ");
  cs_plot_put_number(out, height, MATRIX_DIGITS);
  cs_plot_put(out, "\" width=\"");
  cs_plot_put_number(out, desc->width > 0 ? desc->width : width, MATRIX_DIGITS);
  cs_plot_put(out, "\" height=\"");
  cs_plot_put_number(out, desc->height > 0 ? desc->height : height, MATRIX_DIGITS);
  cs_plot_put(out, "\" preserveAspectRatio=\"none\">\n");
  return CELSPAN_OK;
}

static celspan_status end(cs_plot_text *out, celspan_status status) {
  cs_plot_put(out, "</svg>\n");
  return cs_file_end(out->file, out->context, status == CELSPAN_OK ? out->status : status);
}

static celspan_status write_parcels(drawing *d, const char *path) {
  celspan_context *context = d->text.context;
  const bool is_over = d->desc->flat == CS_FLAT_OVER;
  CS_TRY(judge_pictures(d));
  CS_TRY(cs_under_make(context, &d->parcels, is_over ? growth(d) : 0, &d->under));
  CS_TRY(begin(context, path, d->desc, d->parcels.width, d->parcels.height, &d->text));
  put_gradients(d);
  celspan_status status = is_over ? put_under(d) : CELSPAN_OK;
  if (status == CELSPAN_OK)
    status = put_areas(d);
  d->facts->curves = d->parcels.curve_count;
  return end(&d->text, status);
}

/* A film as nothing but a picture; the context keeps its text, which says why. */
static celspan_status write_picture(celspan_context *context, cs_plot_picture picture,
                                    celspan_point film, const char *path, const cs_plot_desc *desc,
                                    cs_plot_facts *facts) {
  cs_plot_text text;
  char reason[sizeof context->error];
  memcpy(reason, context->error, sizeof reason);
  CS_TRY(size_picture(context, film.x, film.y, desc->scale, &picture));
  CS_TRY(check_picture(context, &picture));
  *facts = (cs_plot_facts){.pictures = 1,
                           .picture_width = picture.columns,
                           .picture_height = picture.rows,
                           .is_picture = true};
  CS_TRY(begin(context, path, desc, film.x, film.y, &text));
  cs_plot_put_picture(&text, &picture, film.x, film.y);
  CS_TRY(end(&text, CELSPAN_OK));
  memcpy(context->error, reason, sizeof reason);
  return CELSPAN_OK;
}

celspan_status cs_plot_write_plane(celspan_context *context, const celspan_plane *plane,
                                   const char *path, const cs_plot_desc *desc,
                                   cs_plot_facts *facts) {
  drawing d = {.text = {.context = context}, .desc = desc, .plane = plane, .facts = facts};
  const cs_plot_picture picture = {
      .draw = draw_plane, .plane = plane, .is_opaque = celspan_plane_is_opaque(plane)};
  *facts = (cs_plot_facts){0};
  celspan_status status = cs_parcels_make(context, plane, &d.parcels);
  const celspan_point film = {d.parcels.width, d.parcels.height};
  const bool is_sum = d.parcels.is_sum;
  if (status == CELSPAN_OK)
    status = write_parcels(&d, path);
  cs_under_finish(&d.under, context->memory);
  cs_parcels_finish(&d.parcels, context->memory);
  return is_sum ? write_picture(context, picture, film, path, desc, facts) : status;
}

celspan_status cs_plot_write_frame(celspan_context *context, const celspan_frame_desc *frame,
                                   const char *path, const cs_plot_desc *desc,
                                   cs_plot_facts *facts) {
  celspan_frame_desc whole = *frame;
  celspan_plane_desc made = CELSPAN_PLANE_DESC;
  celspan_plane *plane;
  whole.film_width = made.width = frame->film_width > 0 ? frame->film_width : frame->width;
  whole.film_height = made.height = frame->film_height > 0 ? frame->film_height : frame->height;
  made.space = frame->space;
  celspan_status status =
      cs_plane_expose(context, frame->exposures, frame->exposure_count, &made, &plane);
  if (status == CELSPAN_OK)
    status = cs_plot_write_plane(context, plane, path, desc, facts);
  celspan_plane_unref(plane);
  if (status == CELSPAN_BAD_ARGUMENT) {
    const cs_plot_picture picture = {
        .draw = draw_frame, .frame = &whole, .is_opaque = celspan_frame_is_opaque(&whole)};
    const celspan_point film = {whole.film_width, whole.film_height};
    return write_picture(context, picture, film, path, desc, facts);
  }
  return status;
}
