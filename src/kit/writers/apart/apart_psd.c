/* A Photoshop document: a layer a cel, of the size of the frame. */
#include "inside/frames.h"
#include "inside/sinks.h"
#include "writers/apart/apart.h"
#include "writers/photoshop/photoshop.h"

typedef struct writing {
  const celspan_frame_desc *desc;
  cs_apart apart;
  cs_apart_progress progress;
  cs_photoshop document;
} writing;

static celspan_status put_picture(writing *w, const celspan_frame_desc *desc,
                                  cs_photoshop_layer *layer) {
  celspan_frame_desc frame = *desc;
  celspan_sink sink;
  cs_apart_report_to(&w->progress, &frame);
  CS_TRY(cs_photoshop_sink(&w->document, layer, &sink));
  return cs_frame_render_own(w->document.context, &frame, &sink, NULL);
}

static celspan_status put_layer(writing *w, size_t index) {
  celspan_frame_desc frame = *w->desc;
  frame.exposures = w->apart.layers[index].exposures;
  frame.exposure_count = w->apart.layers[index].count;
  return put_picture(w, &frame, &w->document.layers[index]);
}

static celspan_status put_all(writing *w) {
  CS_TRY(cs_photoshop_begin(&w->document));
  CS_TRY(put_picture(w, w->desc, NULL));
  for (size_t i = 0; i < w->apart.count; i++)
    CS_TRY(put_layer(w, i));
  return CELSPAN_OK;
}

static celspan_status write_file(writing *w) {
  cs_photoshop_layer *layers;
  celspan_context *context = w->document.context;
  size_t count = w->apart.count, room = count ? count : 1;
  CS_TRY(CS_MAKE(context, layers, room));
  for (size_t i = 0; i < count; i++) {
    const cs_apart_layer *layer = &w->apart.layers[i];
    layers[i] = (cs_photoshop_layer){
        .name = cs_apart_title(layer), .blend = layer->blend, .opacity = layer->opacity};
  }
  w->document.layers = layers;
  w->document.count = count;
  celspan_status status = cs_photoshop_end(&w->document, put_all(w));
  cs_mem_free(context->memory, layers, room * sizeof *layers);
  return status;
}

static celspan_status check_count(const writing *w) {
  return w->apart.count <= CS_PHOTOSHOP_LAYERS
             ? CELSPAN_OK
             : cs_fail(
                   w->document.context, CELSPAN_LIMIT,
                   "%s: the frame has %zu layers, and a Photoshop document at most %d: write an "
                   "OpenEXR file",
                   w->document.path, w->apart.count, CS_PHOTOSHOP_LAYERS);
}

static celspan_status write_layers(writing *w) {
  CS_TRY(check_count(w));
  CS_TRY(cs_apart_take_mixings(&w->apart, CS_PHOTOSHOP_OPACITY));
  w->progress = (cs_apart_progress){.desc = w->desc, .count = w->apart.count + 1};
  return write_file(w);
}

static celspan_status check_sides(const cs_photoshop *document) {
  int32_t width = document->width, height = document->height;
  return width <= CS_PHOTOSHOP_SIDE && height <= CS_PHOTOSHOP_SIDE
             ? CELSPAN_OK
             : cs_fail(document->context, CELSPAN_LIMIT,
                       "%s: the frame has %d x %d pixels, and a Photoshop document at most %d a "
                       "side: write OpenEXR or PNG files, or a smaller --size",
                       document->path, (int)width, (int)height, CS_PHOTOSHOP_SIDE);
}

celspan_status cs_apart_write_psd(celspan_context *context, const celspan_frame_desc *desc,
                                  const char *path, const celspan_file_desc *file) {
  writing w = {.desc = desc,
               .document = {.context = context,
                            .path = path,
                            .coding = cs_pixels_resolve(file->coding, CELSPAN_DEPTH_8),
                            .is_opaque = celspan_frame_is_opaque(desc)}};
  w.document.coding.space = desc->space;
  CS_TRY(cs_frame_check(context, desc));
  w.document.width = desc->crop_width > 0 ? desc->crop_width : desc->width;
  w.document.height = desc->crop_height > 0 ? desc->crop_height : desc->height;
  CS_TRY(check_sides(&w.document));
  CS_TRY(cs_apart_make(context, desc->exposures, desc->exposure_count, 0, &w.apart));
  celspan_status status = write_layers(&w);
  cs_apart_finish(&w.apart);
  return status;
}
