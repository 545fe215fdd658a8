/* Reading: from a file to the facts of its header, and to RGBA floats of a rectangle.
 *
 *   file --Source--> ImageInput --rows or tiles--> batch --> channels, window, orientation --> RGBA
 *
 *   +-----------------------+ display window, of stored_width x stored_height pixels; a rectangle
 *   |  (data_x, data_y)     | is asked for in it, after it was turned upright
 *   |     +----------------------+
 *   |     | data window: the     |  may lie over the edges of the display window; outside it
 *   |     | pixels in the file   |  pixels are clear
 *   +-----|                      |
 *         +----------------------+
 */
#pragma once

#include <memory>
#include <vector>

#ifndef CELSPAN_WITHOUT_SPACES
#include "plugins/ocio/conversion.h"
#endif
#include "plugins/oiio/shared.h"
#include "plugins/oiio/sniff.h"
#include "plugins/oiio/source.h"

/* An open file. */
struct Opened {
  std::string name;
  std::unique_ptr<Source> source;
  std::unique_ptr<OIIO::ImageInput> input;
  Sniffed kind;
  OIIO::ImageSpec spec;
  int subimage = 0;
  int channel[4];                  /* in the file, of red, green, blue, alpha; alpha -1: none */
  int first, last;                 /* the range of channels that is read */
  int orientation;                 /* TIFF's: 1 upright .. 8 */
  int data_x, data_y;              /* the data window, from the display window's corner */
  int stored_width, stored_height; /* the display window as stored, before turning */
  int next_row = 0;                /* of the data window, for sequential formats */
#ifndef CELSPAN_WITHOUT_SPACES
  Conversion conversion; /* to light */
#endif
  bool has_space = false;
  std::vector<float> batch;
  std::vector<unsigned char> stored;
};

[[noreturn]] inline void fail_input(const std::string &what, const std::string &message) {
  throw Failure(CELSPAN_INPUT, what + ": " + first_line(message));
}

/* Opens the file again, from its first row. */
void open_input(Opened &reader);
inline bool is_transposed(const Opened &reader) { return reader.orientation >= 5; }
/* Whether colours are multiplied by alpha. */
bool is_multiplied(const Opened &reader);
/* Fills a rectangle of the display window, upright. */
void read_rectangle(Opened &reader, int32_t x, int32_t y, int32_t width, int32_t height,
                    float *rgba);
