/* Layered paintings: the format of a file, and its layers. */
#include "celspan/layers.h"
#include "readers/layered/document.h"
#include "readers/layered/layer_surface.h"
#include "readers/layered/profile_table.h"
#include "readers/layered/psd.h"

/* ---------------------------------------------------------------- reading */

static celspan_status read_archive(celspan_context *context, const cs_input *input,
                                   celspan_painting *painting) {
  static const cs_document_format *const formats[] = {&cs_openraster_format, &cs_krita_format};
  cs_zip zip;
  CS_TRY(cs_zip_read(context, input, &zip));
  celspan_status status = CELSPAN_OK;
  bool is_found = false;
  for (size_t i = 0; i < sizeof formats / sizeof *formats && !is_found; i++) {
    is_found = cs_zip_find(&zip, formats[i]->member);
    if (is_found)
      status = cs_document_read(context, input, &zip, formats[i], painting);
  }
  cs_zip_finish(&zip);
  return is_found ? status
                  : cs_input_fail(context, input, -1, CELSPAN_INPUT,
                                  "is a zip archive, but neither an OpenRaster file, which holds "
                                  "stack.xml, nor a Krita document, which holds maindoc.xml");
}

/* Where there are fewer than four bytes, zeros stand for the rest. */
static celspan_status read_start(celspan_context *context, const cs_input *input,
                                 unsigned char start[4]) {
  for (int i = 0; i < 4; i++)
    start[i] = 0;
  return cs_input_read(context, input, 0, start, input->size < 4 ? (size_t)input->size : 4);
}

static celspan_status read_format(celspan_context *context, const cs_input *input,
                                  celspan_painting *painting) {
  unsigned char start[4];
  CS_TRY(read_start(context, input, start));
  if (cs_psd_is(start))
    return cs_psd_read(context, input, painting);
  if (start[0] == 'P' && start[1] == 'K')
    return read_archive(context, input, painting);
  return cs_input_fail(context, input, -1, CELSPAN_INPUT,
                       "is not a layered painting; OpenRaster, Krita and Photoshop files are "
                       "read");
}

static void drop_tables(celspan_painting *painting) {
  while (painting->table_count > 0)
    cs_profile_table_unref(painting->tables[--painting->table_count]);
}

/* Gives each layer with pixels its surface. */
static celspan_status make_surfaces(celspan_context *context, const cs_input *input,
                                    celspan_painting *painting) {
  for (size_t i = 0; i < painting->count; i++) {
    cs_contents_layer *layer = &painting->layers[i];
    cs_rows_source *source = layer->source;
    layer->source = NULL;
    if (source)
      CS_TRY(cs_layer_surface_create(context, input, i, source, layer->table, &layer->surface));
  }
  drop_tables(painting);
  return CELSPAN_OK;
}

static celspan_status read_file(celspan_context *context, cs_input *input,
                                celspan_painting *painting) {
  CS_TRY(cs_input_open(context, input));
  celspan_status status = read_format(context, input, painting);
  if (status == CELSPAN_OK)
    status = cs_contents_check_whole(context, input, painting);
  cs_input_close(input);
  return status == CELSPAN_OK ? make_surfaces(context, input, painting) : status;
}

celspan_status celspan_painting_read(celspan_context *context, const char *file,
                                     celspan_painting **out) {
  cs_input input = {.path = file};
  celspan_painting *painting;
  if (!file || !*file)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "painting: file must name a file");
  CS_TRY(cs_contents_create(context, &painting));
  celspan_status status = read_file(context, &input, painting);
  if (status != CELSPAN_OK) {
    celspan_painting_unref(painting);
    return status;
  }
  *out = painting;
  return CELSPAN_OK;
}

/* ---------------------------------------------------------------- life */

celspan_painting *celspan_painting_ref(celspan_painting *painting) {
  atomic_fetch_add_explicit(&painting->references, 1, memory_order_relaxed);
  return painting;
}

void celspan_painting_unref(celspan_painting *painting) {
  if (!painting || atomic_fetch_sub_explicit(&painting->references, 1, memory_order_acq_rel) != 1)
    return;
  cs_memory *memory = painting->memory;
  for (size_t i = 0; i < painting->count; i++) {
    celspan_surface_unref(painting->layers[i].surface);
    if (painting->layers[i].source)
      painting->layers[i].source->kind->destroy(painting->layers[i].source);
  }
  drop_tables(painting);
  cs_mem_free(memory, painting->layers, painting->capacity * sizeof *painting->layers);
  cs_mem_free(memory, painting->notes, painting->note_capacity * sizeof *painting->notes);
  cs_mem_free(memory, painting, sizeof *painting);
  cs_memory_unref(memory);
}

/* ---------------------------------------------------------------- facts */

void celspan_painting_size(const celspan_painting *painting, int32_t *width, int32_t *height) {
  *width = painting->width;
  *height = painting->height;
}

size_t celspan_painting_layer_count(const celspan_painting *painting) { return painting->count; }

bool celspan_painting_layer_at(const celspan_painting *painting, size_t index,
                               celspan_painting_layer *out) {
  if (index >= painting->count)
    return false;
  const cs_contents_layer *layer = &painting->layers[index];
  bool has_pixels = layer->surface && !layer->is_group;
  *out = (celspan_painting_layer){
      .name = layer->name,
      .blend = layer->blend,
      .parent = layer->parent == CS_CONTENTS_NONE ? painting->count : layer->parent,
      .is_group = layer->is_group,
      .is_visible = layer->is_visible,
      .opacity = layer->opacity,
      .x = has_pixels ? layer->x : 0,
      .y = has_pixels ? layer->y : 0,
      .width = has_pixels ? layer->width : 0,
      .height = has_pixels ? layer->height : 0,
      .surface = has_pixels ? layer->surface : NULL,
      .colour = layer->colour,
  };
  return true;
}

size_t celspan_painting_note_count(const celspan_painting *painting) {
  return painting->note_count;
}

const char *celspan_painting_note_at(const celspan_painting *painting, size_t index,
                                     size_t *layer) {
  if (index >= painting->note_count)
    return NULL;
  size_t place = painting->notes[index].layer;
  *layer = place == CS_CONTENTS_NONE ? painting->count : place;
  return painting->notes[index].text;
}
