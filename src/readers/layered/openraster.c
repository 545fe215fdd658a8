/* OpenRaster: an archive of PNG pictures and stack.xml, which describes their order and places. */
#include "readers/layered/document.h"

#include <string.h>

#include "readers/layered/png.h"
#include "readers/layered/png_profile.h"

static celspan_status read_common(cs_document *document, cs_contents_layer *layer) {
  const char *visibility = cs_document_text(document, "visibility");
  const char *blend = cs_document_text(document, "composite-op");
  layer->is_visible = !visibility || strcmp(visibility, "hidden") != 0;
  if (blend)
    cs_document_blend(blend, layer->blend);
  CS_TRY(cs_document_number(document, "opacity", 0, 1, &layer->opacity));
  CS_TRY(cs_document_whole(document, "x", &layer->x));
  return cs_document_whole(document, "y", &layer->y);
}

static celspan_status start_group(cs_document *document) {
  cs_contents_layer *layer;
  if (document->unnamed++ == 0) /* the outermost stack is the painting itself */
    return CELSPAN_OK;
  CS_TRY(cs_document_add(document, true, &layer));
  CS_TRY(read_common(document, layer));
  const char *isolation = cs_document_text(document, "isolation");
  /* A stack that is not isolated blends as if its layers lay outside it. */
  if (isolation && strcmp(isolation, "auto") == 0 && strcmp(layer->blend, "normal") == 0 &&
      layer->opacity == 1)
    strcpy(layer->blend, "pass-through");
  if (layer->x == 0 && layer->y == 0)
    return CELSPAN_OK;
  layer->x = layer->y = 0;
  return cs_contents_note(document->context, document->painting,
                          cs_contents_last(document->painting),
                          "an offset of a group: it stays where it is");
}

static celspan_status read_pixels(cs_document *document, cs_contents_layer *layer) {
  const char *name = cs_document_text(document, "src");
  cs_rows_source *source;
  cs_profile profile;
  int64_t scanned;
  if (!name)
    return cs_document_fail(document, CELSPAN_INPUT, "a layer without src");
  if (!cs_document_is_inside(name))
    return cs_document_fail(document, CELSPAN_INPUT,
                            "src is \"%.200s\"; it must lie in the archive", name);
  const char *ending = strrchr(name, '.');
  if (!ending || strcmp(ending, ".png") != 0)
    return cs_contents_note(document->context, document->painting,
                            cs_contents_last(document->painting),
                            "\"%.100s\", which is not a PNG: it is empty", name);
  const cs_zip_member *member = cs_zip_find(document->zip, name);
  if (!member)
    return cs_document_fail(document, CELSPAN_INPUT,
                            "src is \"%.200s\", which is not in the archive", name);
  CS_TRY(cs_png_create(document->context, document->input, member, &source));
  cs_contents_set_pixels(layer, layer->x, layer->y, source);
  CS_TRY(cs_png_read_profile(document->context, document->input, member, document->painting,
                             &profile, &scanned));
  CS_TRY(cs_document_scan(document, scanned));
  cs_profile_apply(&profile, layer);
  return cs_profile_note(document->context, document->painting,
                         cs_contents_last(document->painting), &profile);
}

static celspan_status start_layer(cs_document *document) {
  cs_contents_layer *layer;
  CS_TRY(cs_document_add(document, false, &layer));
  CS_TRY(read_common(document, layer));
  return read_pixels(document, layer);
}

static celspan_status start(cs_document *document, const char *name) {
  cs_contents_layer *layer;
  if (strcmp(name, "image") == 0)
    return cs_document_size(document, "w", "h");
  if (strcmp(name, "stack") == 0)
    return start_group(document);
  if (strcmp(name, "layer") == 0)
    return start_layer(document);
  if (strcmp(name, "text") != 0)
    return CELSPAN_OK;
  CS_TRY(cs_document_add(document, false, &layer));
  CS_TRY(read_common(document, layer));
  return cs_contents_note(document->context, document->painting,
                          cs_contents_last(document->painting), "text: it is empty");
}

static celspan_status end(cs_document *document, const char *name) {
  if (strcmp(name, "stack") == 0 && --document->unnamed > 0)
    cs_document_close_group(document);
  return CELSPAN_OK;
}

const cs_document_format cs_openraster_format = {"stack.xml", "reading OpenRaster files", start,
                                                 end, CS_CONTENTS_DEPTH + 3};
