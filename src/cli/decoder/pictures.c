#include "cli/decoder/pictures.h"

#include "base/context.h"
#include "cli/decoder/reader.h"
#include "cli/decoder/writer.h"

static const cs_picture_module module = {.version = CS_PICTURE_MODULE_VERSION,
                                         .open = cs_reader_open,
                                         .read = cs_reader_read,
                                         .close = cs_reader_close,
                                         .list = cs_reader_list,
                                         .write_open = cs_writer_open,
                                         .write_rows = cs_writer_rows,
                                         .write_close = cs_writer_complete,
                                         .write_abandon = cs_writer_abandon};

void cs_pictures_begin(celspan_context *context, const cs_decoder_limits *limits) {
  cs_decoder_limit(limits);
  context->picture_module = &module;
}

void cs_pictures_finish(void) { cs_decoder_finish(); }
