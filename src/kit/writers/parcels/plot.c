/* One file, because a page of a plane and one of a frame are put by the same steps. */
#include "writers/parcels/plot.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "inside/frames.h"
#include "inside/scene.h"
#include "writers/parcels/boxes.h"
#include "writers/parcels/plot_picture.h"
#include "writers/parcels/plot_text.h"
#include "writers/parcels/under.h"
#include "writers/plane/plane.h"

#define GROWN 1.6     /* pixels: how far an area continues under another one */
#define OPAQUE 0.999f /* alpha, rounded */
enum { PICTURE_SIDE = 16384 /* pixels, at most */, PROOF_SIDE = 512 };

/* A page that is being written. */
typedef struct drawing {
  celspan_context *context;
  const char *path;
  const cs_plotter *to;
  const cs_plot_desc *desc;
  const celspan_plane *plane;
  cs_parcels parcels;
  cs_under under;
  cs_plot_facts *facts;
} drawing;

/* ---------------------------------------------------------------- paths */

static cs_parcel_stylus stylus_of(const drawing *d) {
  const cs_plotter *to = d->to;
  return (cs_parcel_stylus){to->user, to->move, to->line, to->curve, to->close_path};
}

/* Loops, closed. */
static void put_loops(const drawing *d, size_t first, size_t count) {
  const cs_parcel_stylus stylus = stylus_of(d);
  for (size_t i = first; i < first + count; i++)
    cs_parcel_draw_loop(&d->parcels, &d->parcels.loops[i], &stylus);
}

static cs_plotter_path path_of(const drawing *d, cs_plotter_kind kind, uint32_t number) {
  const cs_parcels *parcels = &d->parcels;
  const cs_fill *fill = &parcels->fills[number];
  return (cs_plotter_path){.kind = kind,
                           .number = number,
                           .fill = fill,
                           .stops = parcels->stops ? parcels->stops + fill->stop : NULL};
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
static celspan_status size_picture(celspan_context *context, celspan_point film, double scale,
                                   cs_plot_picture *out) {
  const double columns = fmax(ceil(film.x * scale), 1), rows = fmax(ceil(film.y * scale), 1);
  if (columns > INT32_MAX || rows > INT32_MAX)
    return cs_fail(context, CELSPAN_LIMIT,
                   "at this scale the film would have %.0f x %.0f pixels; a side has at most %d: "
                   "give a smaller --scale",
                   columns, rows, (int)INT32_MAX);
  out->width = out->columns = (int32_t)columns;
  out->height = out->rows = (int32_t)rows;
  return CELSPAN_OK;
}

static bool is_too_large(const cs_plot_picture *picture) {
  return picture->columns > PICTURE_SIDE || picture->rows > PICTURE_SIDE;
}

static celspan_status check_picture(celspan_context *context, const cs_plot_picture *picture) {
  if (!is_too_large(picture))
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
  CS_TRY(CS_MAKE(d->context, sets, p->fill_count));
  for (size_t i = 0; i < p->fill_count; i++)
    sets[i] = is_wanted(&p->fills[i]);
  celspan_status status = cs_parcels_walk(d->context, p, sets, 1, loops);
  cs_mem_free(d->context->memory, sets, p->fill_count * sizeof *sets);
  return status;
}

static void put_clip(const drawing *d, const char *name, const size_t loops[2]) {
  const cs_plotter_path path = {.kind = CS_PLOTTER_CLIP, .name = name};
  d->to->begin_path(d->to->user, &path);
  put_loops(d, loops[0], loops[1] - loops[0]);
  d->to->end_path(d->to->user, &path);
}

static bool is_picture(const cs_fill *fill) { return fill->kind == CS_FILL_PICTURE; }

static celspan_point film_of(const drawing *d) {
  return (celspan_point){d->parcels.width, d->parcels.height};
}

static celspan_status put_part(drawing *d, cs_plot_picture picture, const cs_box *part) {
  cs_plot_facts *facts = d->facts;
  picture.x = part->x0;
  picture.y = part->y0;
  picture.columns = part->x1 - part->x0;
  picture.rows = part->y1 - part->y0;
  CS_TRY(check_picture(d->context, &picture));
  CS_TRY(cs_plot_picture_put(d->context, d->path, &picture, film_of(d), d->to));
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
  const cs_plotter_group group = {.clip = "picture"};
  size_t loops[2];
  cs_boxes parts = {.count = 0};
  cs_plot_picture picture = {
      .draw = draw_plane, .plane = d->plane, .is_opaque = celspan_plane_is_opaque(d->plane)};
  CS_TRY(unite(d, is_picture, loops));
  if (loops[0] == loops[1])
    return CELSPAN_OK;
  CS_TRY(size_picture(d->context, film_of(d), d->desc->scale, &picture));
  for (size_t i = loops[0]; i < loops[1]; i++)
    cs_boxes_add(&parts, box_of(&d->parcels, &d->parcels.loops[i], &picture));
  put_clip(d, group.clip, loops);
  d->to->begin_group(d->to->user, &group);
  for (size_t i = 0; i < parts.count; i++)
    CS_TRY(put_part(d, picture, &parts.all[i]));
  d->to->end_group(d->to->user, &group);
  return CELSPAN_OK;
}

/* Whether nothing shines through a plane anywhere, by its pixels. */
static celspan_status prove_opaque(const drawing *d, bool *is_opaque) {
  celspan_plane_view view = CELSPAN_PLANE_VIEW;
  cs_plane_rows *rows;
  view.width = view.crop_width = view.height = view.crop_height = PROOF_SIDE;
  view.antialias = CELSPAN_ANTIALIAS_AREA;
  CS_TRY(cs_plane_rows_create(d->context, d->plane, &view, &rows));
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
  const cs_plotter_path path = path_of(d, CS_PLOTTER_AREA, number);
  if (fill->loop_count == 0 || is_picture(fill))
    return;
  d->to->begin_path(d->to->user, &path);
  put_loops(d, fill->loop, fill->loop_count);
  d->to->end_path(d->to->user, &path);
  d->facts->areas++;
}

static celspan_status put_areas(drawing *d) {
  const cs_plotter_group group = {.clip = NULL};
  d->to->begin_group(d->to->user, &group);
  for (size_t i = d->parcels.fill_count; i-- > 0;)
    put_area(d, d->under.order[i]);
  CS_TRY(put_pictures(d));
  d->to->end_group(d->to->user, &group);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- under them */

/* All lines of one colour, from the first; returns the first line after them. */
static size_t put_lines(const drawing *d, size_t first) {
  const cs_under_line *lines = d->under.lines;
  const uint32_t rank = lines[first].rank;
  const cs_plotter_path path = path_of(d, CS_PLOTTER_STROKE, d->under.order[rank]);
  const cs_parcel_stylus stylus = stylus_of(d);
  size_t at = first;
  d->to->begin_path(d->to->user, &path);
  for (; at < d->under.line_count && lines[at].rank == rank; at++)
    cs_under_draw(&d->parcels, &lines[at], &stylus);
  d->to->end_path(d->to->user, &path);
  return at;
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
  const cs_plotter_group group = {.clip = has_clip ? "opaque" : NULL, .stroke = 2 * growth(d)};
  size_t loops[2];
  if (under->line_count == 0)
    return CELSPAN_OK;
  if (has_clip) {
    CS_TRY(unite(d, cs_under_suits, loops));
    put_clip(d, group.clip, loops);
  }
  d->to->begin_group(d->to->user, &group);
  for (size_t i = 0; i < under->line_count;)
    i = put_lines(d, i);
  d->to->end_group(d->to->user, &group);
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- pages */

/* A file of drawings that is being written. */
struct cs_plot {
  cs_plot_text text; /* the bytes of the file */
  cs_plotter to;
  cs_plot_desc desc;
  bool is_in_page;
  char *path; /* owned */
};

static celspan_status begin_page(cs_plot *plot, celspan_point film) {
  const cs_plot_desc *desc = &plot->desc;
  const cs_plotter_page page = {.width = film.x,
                                .height = film.y,
                                .across = desc->width > 0 ? desc->width : film.x,
                                .down = desc->height > 0 ? desc->height : film.y};
  if (desc->is_pdf && fmax(page.across, page.down) > CS_PDF_SIDE)
    return cs_fail(plot->text.context, CELSPAN_LIMIT,
                   "%s: a page would have %.0f x %.0f points; a side of PDF has at most %d: give "
                   "a smaller --size",
                   plot->path, page.across, page.down, CS_PDF_SIDE);
  plot->to.begin_page(plot->to.user, &page);
  plot->is_in_page = true;
  return CELSPAN_OK;
}

/* The first failure: of writing bytes, or of what makes them. */
static celspan_status judge(cs_plot *plot, celspan_status status, const char *reason) {
  cs_plot_text *text = &plot->text;
  if (text->status == CELSPAN_OK && status != CELSPAN_OK)
    text->status = status == CELSPAN_NO_MEMORY
                       ? cs_fail_memory(text->context)
                       : cs_fail(text->context, status, "%s: %s", plot->path, reason);
  return text->status;
}

static celspan_status end_page(cs_plot *plot) {
  const char *reason = "";
  celspan_status status = plot->to.end_page(plot->to.user, &reason);
  plot->is_in_page = false;
  return judge(plot, status, reason);
}

static celspan_status put_parcels(cs_plot *plot, drawing *d) {
  const bool is_over = d->desc->flat == CS_FLAT_OVER;
  CS_TRY(judge_pictures(d));
  CS_TRY(cs_under_make(d->context, &d->parcels, is_over ? growth(d) : 0, &d->under));
  CS_TRY(begin_page(plot, film_of(d)));
  d->to->gradients(d->to->user, &d->parcels);
  CS_TRY(is_over ? put_under(d) : CELSPAN_OK);
  CS_TRY(put_areas(d));
  d->facts->curves = d->parcels.curve_count;
  return end_page(plot);
}

/* A film as nothing but a picture; the context keeps its text, which says why. */
static celspan_status add_picture(cs_plot *plot, cs_plot_picture picture, celspan_point film,
                                  cs_plot_facts *facts) {
  celspan_context *context = plot->text.context;
  char reason[sizeof context->error];
  memcpy(reason, context->error, sizeof reason);
  CS_TRY(size_picture(context, film, plot->desc.scale, &picture));
  if (is_too_large(&picture))
    return cs_fail(context, CELSPAN_LIMIT,
                   "the drawing would be a picture of %d x %d pixels, because it has no vectors "
                   "for this: %s; a side has at most %d: give a smaller --scale",
                   (int)picture.columns, (int)picture.rows, reason, PICTURE_SIDE);
  *facts = (cs_plot_facts){.pictures = 1,
                           .picture_width = picture.columns,
                           .picture_height = picture.rows,
                           .is_picture = true};
  CS_TRY(begin_page(plot, film));
  CS_TRY(cs_plot_picture_put(context, plot->path, &picture, film, &plot->to));
  CS_TRY(end_page(plot));
  memcpy(context->error, reason, sizeof reason);
  return CELSPAN_OK;
}

celspan_status cs_plot_add_plane(cs_plot *plot, const celspan_plane *plane, cs_plot_facts *facts) {
  celspan_context *context = plot->text.context;
  drawing d = {.context = context,
               .path = plot->path,
               .to = &plot->to,
               .desc = &plot->desc,
               .plane = plane,
               .facts = facts};
  const cs_plot_picture picture = {
      .draw = draw_plane, .plane = plane, .is_opaque = celspan_plane_is_opaque(plane)};
  *facts = (cs_plot_facts){0};
  celspan_status status = cs_parcels_make(context, plane, &d.parcels);
  const celspan_point film = film_of(&d);
  const bool is_sum = d.parcels.is_sum;
  if (status == CELSPAN_OK)
    status = put_parcels(plot, &d);
  cs_under_finish(&d.under, context->memory);
  cs_parcels_finish(&d.parcels, context->memory);
  return is_sum ? add_picture(plot, picture, film, facts) : status;
}

celspan_status cs_plot_add_frame(cs_plot *plot, const celspan_frame_desc *frame,
                                 cs_plot_facts *facts) {
  celspan_frame_desc whole = *frame;
  celspan_plane_desc made = CELSPAN_PLANE_DESC;
  celspan_plane *plane;
  whole.film_width = made.width = frame->film_width > 0 ? frame->film_width : frame->width;
  whole.film_height = made.height = frame->film_height > 0 ? frame->film_height : frame->height;
  made.space = frame->space;
  celspan_status status =
      cs_plane_expose(plot->text.context, frame->exposures, frame->exposure_count, &made, &plane);
  if (status == CELSPAN_OK)
    status = cs_plot_add_plane(plot, plane, facts);
  celspan_plane_unref(plane);
  if (status != CELSPAN_BAD_ARGUMENT || plot->is_in_page)
    return status;
  const cs_plot_picture picture = {
      .draw = draw_frame, .frame = &whole, .is_opaque = celspan_frame_is_opaque(&whole)};
  return add_picture(plot, picture, (celspan_point){whole.film_width, whole.film_height}, facts);
}

/* ---------------------------------------------------------------- files */

static celspan_status open_file(cs_plot *plot, const char *path) {
  celspan_context *context = plot->text.context;
  const size_t size = strlen(path) + 1;
  CS_TRY(CS_MAKE(context, plot->path, size));
  memcpy(plot->path, path, size);
  CS_TRY(cs_file_create(context, NULL, path, &plot->text.file));
  if (plot->desc.is_pdf)
    return cs_plot_pdf_open(&plot->text, &plot->to);
  cs_plot_svg_open(&plot->text, &plot->to);
  return CELSPAN_OK;
}

celspan_status cs_plot_begin(celspan_context *context, const char *path, const cs_plot_desc *desc,
                             cs_plot **out) {
  cs_plot *plot;
  CS_TRY(CS_MAKE(context, plot, 1));
  plot->text =
      (cs_plot_text){.context = context, .title = desc->title, .precision = desc->precision};
  plot->desc = *desc;
  celspan_status status = open_file(plot, path);
  *out = status == CELSPAN_OK ? plot : NULL;
  return status == CELSPAN_OK ? CELSPAN_OK : cs_plot_end(plot, status);
}

celspan_status cs_plot_end(cs_plot *plot, celspan_status outcome) {
  celspan_context *context = plot->text.context;
  const char *reason = "";
  /* what is not kept need not be written, either */
  if (plot->text.status == CELSPAN_OK)
    plot->text.status = outcome;
  celspan_status status = plot->to.close ? plot->to.close(plot->to.user, &reason) : CELSPAN_OK;
  status = judge(plot, status, reason);
  if (plot->text.file)
    status = cs_file_end(plot->text.file, context, status);
  if (plot->path)
    cs_mem_free(context->memory, plot->path, strlen(plot->path) + 1);
  cs_mem_free(context->memory, plot, sizeof *plot);
  return status;
}

bool cs_plot_say(const celspan_context *context, const char *path, const cs_plot_desc *desc,
                 const cs_plot_facts *facts, char text[CS_PLOT_SAID]) {
  const char *format = desc->is_pdf ? "PDF" : "SVG";
  const int width = facts->picture_width, height = facts->picture_height;
  if (facts->is_picture)
    snprintf(text, CS_PLOT_SAID,
             "%s: is a picture of %d x %d pixels, because it has no vectors for this: %s", path,
             width, height, celspan_context_error(context));
  else if (facts->pictures == 1)
    snprintf(text, CS_PLOT_SAID,
             "%s: what %s has no vectors for is a picture of %d x %d pixels, beside %zu areas",
             path, format, width, height, facts->areas);
  else
    snprintf(text, CS_PLOT_SAID,
             "%s: what %s has no vectors for is %zu pictures, the largest of %d x %d pixels, "
             "beside %zu areas",
             path, format, facts->pictures, width, height, facts->areas);
  return facts->pictures > 0;
}
