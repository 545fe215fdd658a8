/* Krita documents: an archive of layers in tiles and maindoc.xml, which describes their order and
 * places. Layers whose pixels Krita computes (filters, fills, vectors, clones, files) are noted. */
#include "readers/layered/document.h"

#include <stdio.h>
#include <string.h>

#include "common/blend_names.h"
#include "readers/layered/krita_tiles.h"

static bool is(const char *text, const char *word) { return text && strcmp(text, word) == 0; }

static celspan_status note(cs_document *document, const char *sentence) {
  return cs_contents_note(document->context, document->painting,
                          cs_contents_last(document->painting), "%s", sentence);
}

/* ---------------------------------------------------------------- layers */

static celspan_status read_common(cs_document *document, cs_contents_layer *layer) {
  double opacity = 255;
  const char *blend = cs_document_text(document, "compositeop");
  layer->is_visible = !is(cs_document_text(document, "visible"), "0");
  CS_TRY(cs_document_number(document, "opacity", 0, 255, &opacity));
  layer->opacity = opacity / 255;
  if (blend)
    cs_blend_word_of_openraster(blend, layer->blend);
  if (is(cs_document_text(document, "passthrough"), "1") && layer->is_group)
    strcpy(layer->blend, "pass-through");
  CS_TRY(cs_document_whole(document, "x", &layer->x));
  return cs_document_whole(document, "y", &layer->y);
}

/* The channels that a layer changes, with alpha last: "1110" does not change the alpha of the
 * layers below. */
static celspan_status read_channels(cs_document *document) {
  const char *flags = cs_document_text(document, "channelflags");
  const char *off = flags ? strchr(flags, '0') : NULL;
  if (!off)
    return CELSPAN_OK;
  if (off[1])
    return note(document, "some channels are switched off: it is shown whole");
  document->painting->layers[cs_contents_last(document->painting)].is_within = true;
  return cs_contents_note_own(document->context, document->painting,
                              "alpha is inherited from the layers below: it is shown whole");
}

/* Finds the folder of the layers, whose names begin with "folder/layers/". The folder normally has
 * the image's name. If there is no such folder, the first folder that contains "layers/" is
 * used. */
static void find_folder(cs_document *document, const char *name) {
  static const char between[] = "/layers/";
  const cs_zip *zip = document->zip;
  char start[320];
  snprintf(document->folder, sizeof document->folder, "%s", name);
  snprintf(start, sizeof start, "%s%s", document->folder, between);
  size_t place = cs_zip_place(zip, start);
  bool is_there =
      place < zip->count && strncmp(zip->members[place].name, start, strlen(start)) == 0;
  for (size_t i = 0; i < zip->count && !is_there; i++) {
    const char *other = zip->members[i].name, *end = strstr(other, between);
    is_there = end && (size_t)(end - other) < sizeof document->folder;
    if (is_there)
      snprintf(document->folder, (size_t)(end - other) + 1, "%s", other);
  }
}

/* The member of a layer whose name has this ending. */
static const cs_zip_member *find_member(const cs_document *document, const char *name,
                                        const char *ending) {
  char path[640];
  snprintf(path, sizeof path, "%s/layers/%.300s%s", document->folder, name, ending);
  return cs_zip_find(document->zip, path);
}

/* ---------------------------------------------------------------- colour profiles */

/* The embedded profile; if there is none, the profile that is named; if there is neither, *out does
 * not change. */
static celspan_status read_profile(cs_document *document, const cs_zip_member *member,
                                   cs_profile *out) {
  const char *name = cs_document_text(document, "profile");
  unsigned char *bytes;
  size_t size;
  if (!member && name)
    cs_profile_of_name(name, out);
  if (!member)
    return CELSPAN_OK;
  CS_TRY(cs_zip_load(document->context, document->input, member, CS_PROFILE_BYTES, &bytes, &size));
  celspan_status status = cs_profile_read(document->context, document->input, document->painting,
                                          &(cs_colour_request){.bytes = bytes, .size = size}, out);
  cs_mem_free(document->context->memory, bytes, size + 1);
  CS_TRY(status);
  return cs_document_scan(document, (int64_t)size);
}

static celspan_status start_image(cs_document *document) {
  const char *name = cs_document_text(document, "name");
  char path[320];
  CS_TRY(cs_document_size(document, "width", "height"));
  find_folder(document, name ? name : "");
  snprintf(path, sizeof path, "%s/annotations/icc", document->folder);
  CS_TRY(read_profile(document, cs_zip_find(document->zip, path), &document->profile));
  return cs_profile_note(document->context, document->painting, CS_CONTENTS_NONE,
                         &document->profile);
}

/* The profile of a layer's pixels; adds a note if it differs from the profile of the image. */
static celspan_status read_layer_profile(cs_document *document, const char *name,
                                         cs_contents_layer *layer) {
  cs_profile profile = document->profile;
  CS_TRY(read_profile(document, find_member(document, name, ".icc"), &profile));
  cs_profile_apply(&profile, layer);
  if (strcmp(profile.name, document->profile.name) == 0)
    return CELSPAN_OK;
  return cs_profile_note(document->context, document->painting,
                         cs_contents_last(document->painting), &profile);
}

/* ---------------------------------------------------------------- pixels */

/* The pixel that Krita uses where there is no tile. */
static celspan_status read_default(cs_document *document, const char *name,
                                   cs_krita_tiles_form *form) {
  unsigned char *bytes;
  size_t size;
  const cs_zip_member *member = find_member(document, name, ".defaultpixel");
  if (!member)
    return CELSPAN_OK;
  CS_TRY(cs_zip_load(document->context, document->input, member, 64, &bytes, &size));
  if (size == (size_t)form->pixel_size)
    memcpy(form->beyond, bytes, size);
  cs_mem_free(document->context->memory, bytes, size + 1);
  return CELSPAN_OK;
}

static celspan_status read_pixels(cs_document *document, cs_contents_layer *layer) {
  const char *name = cs_document_text(document, "filename");
  const char *space = cs_document_text(document, "colorspacename");
  cs_krita_tiles_form form = {.width = document->painting->width,
                              .height = document->painting->height};
  if (!name || !cs_document_is_inside(name) || strchr(name, '/'))
    return cs_document_fail(document, CELSPAN_INPUT,
                            "filename is \"%.200s\"; it must name a layer of the archive",
                            name ? name : "");
  if (!cs_krita_tiles_form_of(space ? space : "RGBA", &form))
    return cs_contents_note(document->context, document->painting,
                            cs_contents_last(document->painting),
                            "pixels in the colour space %.40s: it is empty", space);
  const cs_zip_member *member = find_member(document, name, "");
  if (!member)
    return cs_document_fail(document, CELSPAN_INPUT,
                            "filename is \"%.200s\", which is not in the archive", name);
  CS_TRY(read_default(document, name, &form));
  int32_t x = layer->x, y = layer->y;
  form.x = -x;
  form.y = -y;
  cs_rows_source *source = NULL;
  CS_TRY(read_layer_profile(document, name, layer));
  CS_TRY(cs_krita_tiles_create(document->context, document->input, member, &form, &source));
  if (source)
    cs_contents_set_pixels(layer, x + form.x, y + form.y, source);
  CS_TRY(cs_document_scan(document, form.scanned));
  if (!source)
    return CELSPAN_OK;
  return cs_contents_check_corner(document->context, document->input, "a layer", layer->x,
                                  layer->y);
}

static celspan_status start_layer(cs_document *document) {
  const char *type = cs_document_text(document, "nodetype");
  cs_contents_layer *layer;
  bool is_group = is(type, "grouplayer");
  /* it may have masks, so it is closed with its element */
  CS_TRY(cs_document_add(document, true, &layer));
  layer->is_group = is_group;
  CS_TRY(read_common(document, layer));
  if (is_group) {
    layer->x = layer->y = 0;
    return read_channels(document);
  }
  if (type && !is(type, "paintlayer"))
    return cs_contents_note(document->context, document->painting,
                            cs_contents_last(document->painting), "is a \"%.60s\": it is empty",
                            type);
  CS_TRY(read_pixels(document, layer));
  if (cs_document_text(document, "keyframes"))
    CS_TRY(note(document, "animation: its first drawing is shown"));
  return read_channels(document);
}

static celspan_status start_mask(cs_document *document) {
  const char *type = cs_document_text(document, "nodetype");
  if (document->group == CS_CONTENTS_NONE)
    return CELSPAN_OK; /* this is a selection for the whole painting */
  return cs_contents_note(document->context, document->painting, document->group,
                          "has a \"%.60s\": it changes nothing here", type ? type : "mask");
}

static celspan_status start(cs_document *document, const char *name) {
  if (is(name, "IMAGE"))
    return start_image(document);
  if (is(name, "layer"))
    return document->has_size
               ? start_layer(document)
               : cs_document_fail(document, CELSPAN_INPUT, "a layer comes before the image");
  return is(name, "mask") ? start_mask(document) : CELSPAN_OK;
}

static celspan_status end(cs_document *document, const char *name) {
  if (is(name, "layer"))
    cs_document_close_group(document);
  return CELSPAN_OK;
}

/* A group is a layer that contains a list. */
const cs_document_format cs_krita_format = {"maindoc.xml", "reading Krita files", start, end,
                                            2 * CS_CONTENTS_DEPTH + 16};
